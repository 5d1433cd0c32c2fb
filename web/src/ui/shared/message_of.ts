import { serverWords } from '../../words/words.ts';

/** The words of whatever was thrown; those of the libraries that the server has too are in the language of the page. */
export function messageOf(error: unknown): string {
  return serverWords(error instanceof Error ? error.message : String(error));
}

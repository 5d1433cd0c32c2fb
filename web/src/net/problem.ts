import { anyFormat } from './model_formats.ts';
import type { Problem } from './types.ts';
import { problemTitle, serverWords, t } from '../words/words.ts';

/** One error of a problem document; without a pointer it concerns the whole request. */
export interface FieldProblem {
  pointer?: string;
  detail: string;
}

/** A failed request. `problem.status` is 0 when there was no response; `retryAfter`: seconds, if the server says so. */
export class ApiError extends Error {
  constructor(
    readonly problem: Problem,
    readonly retryAfter: number | null = null,
  ) {
    super(wordsOf(problem));
    this.name = 'ApiError';
  }
}

/** Without an answer; `detail`: what was cut short. */
export const unreachable = (detail?: string): Problem => ({
  type: '/problems/unreachable',
  title: t('The server does not respond'),
  status: 0,
  ...(detail === undefined ? {} : { detail }),
});

const slugOf = (problem: Problem): string => problem.type.split('/').pop() ?? '';

/** The title of a problem in the language of the page. */
export const titleOf = (problem: Problem): string => problemTitle(slugOf(problem)) ?? problem.title;

/** What a problem says: its detail, after the title if that alone has a translation. */
export function wordsOf(problem: Problem): string {
  const title = titleOf(problem);
  if (problem.detail === undefined) return title;
  const detail = serverWords(problem.detail);
  return title === problem.title || detail !== problem.detail ? detail : `${title}: ${detail}`;
}

/** Parses the body of an error response. Any other body is wrapped in a problem document, so callers have one case. */
export function problemFrom(status: number, statusText: string, contentType: string, body: string): Problem {
  if (/^application\/(problem\+)?json\b/.test(contentType)) {
    try {
      const value: unknown = JSON.parse(body);
      if (isProblem(value)) return { ...value, status: value.status || status };
    } catch {
      // Not valid JSON in spite of its media type: fall through to the plain form.
    }
  }
  const problem: Problem = { type: 'about:blank', title: statusText || `HTTP ${status}`, status };
  const text = body.trim();
  if (text !== '' && text.length < 300 && !text.startsWith('<')) problem.detail = text;
  return problem;
}

function isProblem(value: unknown): value is Problem {
  return typeof value === 'object' && value !== null && typeof (value as Problem).title === 'string';
}

/** The errors of a problem as (pointer, reason); a problem without pointers gives one entry without a pointer. */
export function fieldProblems(problem: Problem): FieldProblem[] {
  if (problem.errors && problem.errors.length > 0)
    return problem.errors.map((error) => ({ ...error, detail: serverWords(error.detail) }));
  const detail = wordsOf(problem);
  return [problem.pointer === undefined ? { detail } : { pointer: problem.pointer, detail }];
}

/** The feature point id in a pointer such as `/points/2.1/vertex`, or null. */
export function featurePointOf(pointer: string | undefined): string | null {
  const match = /^\/points\/(\d{1,2}\.\d{1,2})(?:\/|$)/.exec(pointer ?? '');
  return match ? match[1]! : null;
}

type Advice = NonNullable<Problem['advice']>;

/** What the server's advice means in the studio; core/types/advice.h has the kinds. */
const adviceWords: Readonly<Record<Advice, string>> = {
  'export-as-glb': t('Open it in the program that made it, or in Blender, and export it as GLB.'),
  'export-again': t('Export the head again as {anyFormat}.', { anyFormat }),
  unpack: t('Unpack it, and upload the model that is in it or a zip.'),
  'choose-model': t('Choose the file of the model itself.'),
  'download-model': t('Download the model itself, and upload that file.'),
  'fetch-from-lfs': t('Fetch the model with “git lfs pull”, and upload it again.'),
  'send-all-files': t('Upload a GLB, or a zip with all files of the model.'),
  'send-one-model': t('Leave one model in it, and upload it again.'),
  'reduce-model': t('Reduce the mesh or its textures and upload it again.'),
  'mark-points': t('Mark the points that are missing, then try again.'),
  'move-points': t('Move or remove the points marked in red, then save again.'),
  'store-again': t('Upload the same file again, or parametrize the head again.'),
  'free-disk': t("The server's disk is full: free some space on it, then try again."),
  'delete-unused': t('Delete what is no longer needed, then try again.'),
  wait: t('The server is busy: wait a moment and try again.'),
  'look-again': t('Look at what has changed, then try again.'),
  'sign-in': t('Sign in again.'),
  'ask-for-token': t('Ask whoever runs the server for a token that allows it.'),
};

/**
 * Advice for the user in one sentence, or null when there is none better than "try again". The server names it; what failed
 * without its word (no answer, a proxy in front of it, a page that is out of date) is known by the status. Faults that earlier
 * versions have stored name none: their details say what helps.
 */
export function adviceFor(problem: Problem): string | null {
  // A newer server may name advice that this page does not know.
  if (problem.advice !== undefined) return (adviceWords as Readonly<Record<string, string>>)[problem.advice] ?? null;
  if (problem.status === 0) return t('Check that the server is running, then try again.');
  if (problem.status === 404) return t('It may have been deleted: reload the page.');
  if (problem.type !== 'about:blank') return null;
  if (problem.status === 413) return adviceWords['reduce-model'];
  if (problem.status === 429 || problem.status === 503) return adviceWords.wait;
  return null;
}

/** What browsers say when a part of the page does not come: without a network, or because the server has newer pages than this one. */
const missingPart = /dynamically imported module|Importing a module script failed|Unable to preload/;

export function problemOf(error: unknown): Problem {
  if (error instanceof ApiError) return error.problem;
  if (error instanceof Error && missingPart.test(error.message))
    return { type: 'about:blank', title: t('A part of this page did not come'), status: -1, detail: t('Reload the page: the server may have a newer one. Unsaved points stay.') };
  const detail = error instanceof Error ? error.message : String(error);
  return { type: 'about:blank', title: t('Something went wrong on this page'), status: -1, detail };
}

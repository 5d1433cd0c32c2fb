import { portugueseDetails } from './portuguese_details.ts';
import { portugueseRemarks } from './portuguese_remarks.ts';
import { sentenceTranslator } from './server_sentences.ts';

/** A sentence of the server in Brazilian Portuguese; null: there is no translation. */
export const portugueseSentence = sentenceTranslator({ ...portugueseRemarks, ...portugueseDetails });

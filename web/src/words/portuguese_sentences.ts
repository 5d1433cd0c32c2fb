import { portugueseDetails } from './portuguese_details.ts';
import { portugueseGltfFaults } from './portuguese_gltf_faults.ts';
import { portugueseMeshFaults } from './portuguese_mesh_faults.ts';
import { portugueseMotionFaults } from './portuguese_motion_faults.ts';
import { portugueseRemarks } from './portuguese_remarks.ts';
import { portugueseRequests } from './portuguese_requests.ts';
import { portugueseSpeechFaults } from './portuguese_speech_faults.ts';
import { portugueseStreamFaults } from './portuguese_stream_faults.ts';
import { portugueseStreamRequests } from './portuguese_stream_requests.ts';
import { portugueseWork } from './portuguese_work.ts';
import { sentenceTranslator, type Sentences } from './server_sentences.ts';

/** The tables of the server's sentences by their subject; no sentence is in two. */
export const portugueseTables: Readonly<Record<string, Sentences>> = {
  remark: portugueseRemarks,
  detail: portugueseDetails,
  gltfFault: portugueseGltfFaults,
  meshFault: portugueseMeshFaults,
  motionFault: portugueseMotionFaults,
  speechFault: portugueseSpeechFaults,
  request: portugueseRequests,
  streamRequest: portugueseStreamRequests,
  streamFault: portugueseStreamFaults,
  work: portugueseWork,
};

/** A sentence of the server in Brazilian Portuguese; null: there is no translation. */
export const portugueseSentence = sentenceTranslator(Object.assign({}, ...Object.values(portugueseTables)) as Sentences);

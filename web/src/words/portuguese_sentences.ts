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

/** Sentences of earlier versions, as stored with heads whose import failed then. They say what helps; newer faults name it. */
export const formerSentences: Sentences = {
  'the zip has no model but {name}: export the head as GLB': 'o zip não tem modelo, mas {name}: exporte a cabeça como GLB',
  'the zip has no model but {name}: send the model that is in it': 'o zip não tem modelo, mas {name}: envie o modelo que há nele',
  'refers to {name}, which is another file; send a GLB, or a zip with all files':
    'cita {name}, que é outro arquivo; envie um GLB, ou um zip com todos os arquivos',
  '{fault}; missing from the quick set: {points}': '{fault}; faltam do conjunto rápido: {points}',
  'vertex colours are omitted: the face has the colours of its materials': 'as cores de vértices ficaram de fora: o rosto tem as cores dos seus materiais',
};

/** A sentence of the server in Brazilian Portuguese; null: there is no translation. */
export const portugueseSentence = sentenceTranslator(Object.assign({}, ...Object.values(portugueseTables), formerSentences) as Sentences);

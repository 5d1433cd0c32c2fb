import type { RecordingFormat } from './types.ts';

/** Endings of the files that a recording becomes. */
export const recordingEndings: Record<RecordingFormat, string> = {
  performance: '.json',
  fap: '.fap',
  'arkit-csv': '.csv',
  glb: '.glb',
  opus: '.opus',
  'frames-json': '.frames.json',
};

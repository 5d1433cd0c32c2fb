import type { RecordingFormat } from '../../net/types.ts';
import { t } from '../../words/words.ts';

/** The formats of a recording, each with its name and what it is. */
export const recordingFormats: readonly [RecordingFormat, string, string][] = [
  ['performance', t('Performance'), t('A performance document, JSON')],
  ['fap', '.fap', t('A .fap file, in whole FAP units')],
  ['arkit-csv', t('ARKit CSV'), t('A take in the format of Live Link Face')],
  ['glb', t('GLB clip'), t('The open head with its skin and one animation')],
  ['opus', t('Sound'), t('The sound, Ogg/Opus, on the clock of the GLB clip')],
  ['frames-json', t('Frames'), t('Every frame, JSON')],
];

/** Those in which a recording can be saved; `sound`: null when the server does not know. */
export const formatsOf = (sound: boolean | null): typeof recordingFormats =>
  recordingFormats.filter(([format]) => format !== 'opus' || sound !== false);

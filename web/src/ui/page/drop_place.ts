import type { Tab } from '../shared/studio.ts';

/** The receiver of a dropped file: the Live tab (stream), the Animate tab (page), its Speak panel (speech) or the upload of heads. */
export type DropPlace = 'stream' | 'page' | 'speech' | 'heads';

/** Sound files that the server may read; one without an ending here is chosen by the button of the panel. */
export const soundEndings = ['.wav', '.flac', '.ogg', '.oga', '.opus', '.mp3'];

/** Depends on the open tab. In tabs without a receiver, a performance goes to `stream`, a .fap file to `page`. */
export function dropPlace(name: string, tab: Tab): DropPlace {
  if (soundEndings.some((ending) => name.toLowerCase().endsWith(ending))) return 'speech';
  const fap = /\.fap$/i.test(name);
  if (!fap && !/\.json$/i.test(name)) return 'heads';
  if (tab === 'live') return 'stream';
  return fap || tab === 'animate' ? 'page' : 'stream';
}

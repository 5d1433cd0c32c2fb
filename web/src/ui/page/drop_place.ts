import type { Tab } from '../shared/studio.ts';
import { soundEndings } from '../speak/sound_files.ts';

/** The receiver of a dropped file: the Live tab (stream), the Animate tab (page), its Speak panel (speech) or the upload of heads. */
export type DropPlace = 'stream' | 'page' | 'speech' | 'heads';

/** Depends on the open tab. In tabs without a receiver, a performance goes to `stream`, a .fap file to `page`. */
export function dropPlace(name: string, tab: Tab): DropPlace {
  if (soundEndings.some((ending) => name.toLowerCase().endsWith(ending))) return 'speech';
  const fap = /\.fap$/i.test(name);
  if (!fap && !/\.json$/i.test(name)) return 'heads';
  if (tab === 'live') return 'stream';
  return fap || tab === 'animate' ? 'page' : 'stream';
}

import type { Tab } from '../shared/studio.ts';

/** What reads a dropped file: the Live tab (stream), the Animate tab (page) or the upload of heads. */
export type DropPlace = 'stream' | 'page' | 'heads';

/** By the open tab; in tabs that take no documents a performance goes to the streams, a .fap file to this page. */
export function dropPlace(name: string, tab: Tab): DropPlace {
  const fap = /\.fap$/i.test(name);
  if (!fap && !/\.json$/i.test(name)) return 'heads';
  if (tab === 'live') return 'stream';
  return fap || tab === 'animate' ? 'page' : 'stream';
}

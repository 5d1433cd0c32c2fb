import type { Tab } from '../shared/studio.ts';

/** Where a file goes that is dropped: into a stream, onto the face of this page alone, or among the heads. */
export type DropPlace = 'stream' | 'page' | 'heads';

/** By the tab one is in; where no tab says, a performance goes to the streams and a .fap file stays on the page. */
export function dropPlace(name: string, tab: Tab): DropPlace {
  const fap = /\.fap$/i.test(name);
  if (!fap && !/\.json$/i.test(name)) return 'heads';
  if (tab === 'live') return 'stream';
  return fap || tab === 'animate' ? 'page' : 'stream';
}

import { beginsAsFap } from '../../face/clip_file.ts';
import type { Tab } from '../shared/studio.ts';
import { soundEndings } from '../speak/sound_files.ts';

/** The receiver of a dropped file: the feature points, the Live tab (stream), the Animate tab (page), its Speak panel (speech) or the upload of heads. */
export type DropPlace = 'points' | 'stream' | 'page' | 'speech' | 'heads';

export type DroppedKind = 'points' | 'performance' | 'fap' | 'sound' | 'head';

/** Larger JSON files are no points: there are 84 of them. Bytes. */
const mostPoints = 1 << 20;
/** What tells the kind of a file stands in its first bytes. */
const startLength = 4096;

/**
 * What a file is, by its content; by the ending of its name where the content does not tell: then whoever reads it says what is wrong
 * with it.
 */
export async function kindOfFile(file: Pick<File, 'name' | 'size' | 'text' | 'slice'>): Promise<DroppedKind> {
  const name = file.name.toLowerCase();
  const start = await file.slice(0, startLength).text();
  if (/^(RIFF[^]{4}WAVE|OggS|fLaC|ID3)/.test(start)) return 'sound';
  if (beginsAsFap(start)) return 'fap';
  if (/^\uFEFF?\s*\{/.test(start)) {
    if (/"format"\s*:\s*"semblante\.performance"/.test(start)) return 'performance';
    if (file.size <= mostPoints && isPoints(await file.text())) return 'points';
  }
  if (soundEndings.some((ending) => name.endsWith(ending))) return 'sound';
  if (name.endsWith('.fap')) return 'fap';
  return name.endsWith('.json') ? 'performance' : 'head';
}

/** Where a file goes: motion by the open tab; in tabs without a receiver, a performance goes to `stream`, a .fap file to `page`. */
export function dropPlace(kind: DroppedKind, tab: Tab): DropPlace {
  switch (kind) {
    case 'points':
      return 'points';
    case 'sound':
      return 'speech';
    case 'head':
      return 'heads';
    case 'fap':
      return tab === 'live' ? 'stream' : 'page';
    case 'performance':
      return tab === 'animate' ? 'page' : 'stream';
  }
}

/** Whether a text is a set of feature points, right or wrong: the server says what is wrong with it. */
function isPoints(text: string): boolean {
  try {
    const value: unknown = JSON.parse(text);
    return typeof value === 'object' && value !== null && 'points' in value;
  } catch {
    return false;
  }
}

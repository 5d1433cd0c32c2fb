import type { Tab } from '../shared/studio.ts';
import { soundEndings } from '../speak/sound_files.ts';

/** The receiver of a dropped file: the feature points, the Live tab (stream), the Animate tab (page), its Speak panel (speech) or the upload of heads. */
export type DropPlace = 'points' | 'stream' | 'page' | 'speech' | 'heads';

/** Larger JSON files are no points: there are 84 of them. Bytes. */
const mostPoints = 1 << 20;

/**
 * A file of feature points is one on every tab. Other documents go by the open tab; in tabs without a receiver, a performance goes to
 * `stream`, a .fap file to `page`.
 */
export async function dropPlace(file: Pick<File, 'name' | 'size' | 'text'>, tab: Tab): Promise<DropPlace> {
  const name = file.name.toLowerCase();
  if (soundEndings.some((ending) => name.endsWith(ending))) return 'speech';
  if (name.endsWith('.fap')) return tab === 'live' ? 'stream' : 'page';
  if (!name.endsWith('.json')) return 'heads';
  if (file.size <= mostPoints && isPoints(await file.text())) return 'points';
  return tab === 'animate' ? 'page' : 'stream';
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

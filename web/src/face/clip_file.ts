import { Performance, readTake, type Library, type Take } from '@client/motion/index.ts';
import { FrameClip, type Clip } from './clip.ts';
import { PerformanceClip } from './performance_clip.ts';

/** The parsed content of a file that can be played. */
export type ClipFile =
  | { kind: 'fap'; text: string; take: Take }
  | { kind: 'performance'; text: string; performance: Performance; cues: number; hasIdle: boolean };

export type ClipKind = ClipFile['kind'];

/** Whether a text begins as a .fap file does: comments, then the version of the format, a name, frames a second and the number of frames. */
export const beginsAsFap = (text: string): boolean => /^(\s*#.*\n)*\s*\d\.\d+\s+\S+\s+[\d.]+\s+\d+\s*(\n|$)/.test(text);

/** What a file of motion is, by its text; by the ending of its name where the text does not tell, so that its reader says what is wrong. */
export function kindOfClip(name: string, text: string): ClipKind {
  if (beginsAsFap(text)) return 'fap';
  return /^\uFEFF?\s*\{/.test(text) || !/\.fap$/i.test(name) ? 'performance' : 'fap';
}

/** Throws ProtocolError with the line (.fap) or the JSON pointer (performance document) of the error. */
export function readClipFile(library: Library, kind: ClipKind, text: string): ClipFile {
  if (kind === 'fap') return { kind: 'fap', text, take: readTake(library, 'fap', text) };
  const performance = new Performance(library, text);
  const { cues, idle } = JSON.parse(text) as { cues?: unknown[]; idle?: object };
  return { kind: 'performance', text, performance, cues: cues?.length ?? 0, hasIdle: idle !== undefined };
}

/** `absent`: the value of a FAP that a frame of a .fap file omits: zero, or the value of the frame before. */
export function clipOf(library: Library, file: ClipFile, absent: 'zero' | 'keep'): Clip {
  if (file.kind === 'performance') return new PerformanceClip(file.performance, file.text);
  const take = absent === 'zero' ? file.take : readTake(library, 'fap', file.text, { absent });
  return new FrameClip(take.frames);
}

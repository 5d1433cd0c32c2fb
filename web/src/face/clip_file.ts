import { readPerformance, type PerformanceScript } from '@client/index.ts';
import { parseFap, type FapFileReading } from '@protocol/fap_file.ts';
import { FrameClip, type Clip } from './clip.ts';
import { PerformanceClip } from './performance_clip.ts';

/** The parsed content of a file that can be played. */
export type ClipFile = { kind: 'fap'; reading: FapFileReading } | { kind: 'performance'; script: PerformanceScript };

/** The kind of a clip file, from the extension of its name. */
export const kindOfClip = (name: string): ClipFile['kind'] => (/\.fap$/i.test(name) ? 'fap' : 'performance');

/** Throws ProtocolError with the line (.fap) or the JSON pointer (performance document) of the error. */
export function readClipFile(name: string, text: string): ClipFile {
  return kindOfClip(name) === 'fap'
    ? { kind: 'fap', reading: parseFap(text) }
    : { kind: 'performance', script: readPerformance(text) };
}

/** `absent`: the value of a FAP that a frame of a .fap file omits: zero, or the value of the frame before. */
export function clipOf(file: ClipFile, absent: 'zero' | 'keep'): Clip {
  return file.kind === 'fap' ? FrameClip.ofFap(file.reading.file, { absent }) : new PerformanceClip(file.script);
}

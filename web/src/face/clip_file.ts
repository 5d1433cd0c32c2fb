import { readPerformance, type PerformanceScript } from '@client/index.ts';
import { parseFap, type FapFileReading } from '@protocol/fap_file.ts';
import { FrameClip, type Clip } from './clip.ts';
import { PerformanceClip } from './performance_clip.ts';

/** What is in a file that can be played. */
export type ClipFile = { kind: 'fap'; reading: FapFileReading } | { kind: 'performance'; script: PerformanceScript };

/** By the ending of a file's name. */
export const kindOfClip = (name: string): ClipFile['kind'] => (/\.fap$/i.test(name) ? 'fap' : 'performance');

/** Throws ProtocolError with the line, or the JSON pointer. */
export function readClipFile(name: string, text: string): ClipFile {
  return kindOfClip(name) === 'fap'
    ? { kind: 'fap', reading: parseFap(text) }
    : { kind: 'performance', script: readPerformance(text) };
}

/** `absent`: what a FAP is that a frame of a .fap file leaves out. */
export function clipOf(file: ClipFile, absent: 'zero' | 'keep'): Clip {
  return file.kind === 'fap' ? FrameClip.ofFap(file.reading.file, { absent }) : new PerformanceClip(file.script);
}

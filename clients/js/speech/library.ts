import { withBytes } from '../bytes.ts';
import { Runtime, type Memory } from '../runtime.ts';
import { bytesOf } from '../wasm.ts';

/** The functions of libsemblante for the face of a client's own voice. */
export interface SpeakerFunctions extends Memory {
  semblante_speaker_create(seed: number, speaker: number, error: number): number;
  semblante_speaker_destroy(speaker: number): void;
  semblante_speaker_say(speaker: number, score: number, size: number, firstWord: number, now: number): number;
  semblante_speaker_reach(speaker: number, word: number, now: number): void;
  semblante_speaker_end(speaker: number, now: number): void;
  semblante_speaker_show(speaker: number, now: number, frame: number): number;
  semblante_speaker_unpack(packed: number, size: number, plain: number, capacity: number): number;
}

/** The part of libsemblante that has them: `semblante_speak.wasm`, which only pages that speak load. */
export type SpeakerLibrary = Runtime<SpeakerFunctions>;

export function loadSpeakers(): Promise<SpeakerLibrary> {
  return Runtime.open<SpeakerFunctions>(bytesOf(new URL('./semblante_speak.wasm', import.meta.url)));
}

/** The plain form of a packed text (protocol/SPEC.md, section 5); null: it is none. */
export type UnpackText = (packed: Uint8Array) => Uint8Array | null;

/** Text, score and language at their limits (protocol/schema/messages.json), with what precedes them. */
const largestPlain = 6100;
let unpacking: Promise<UnpackText> | null = null;

/** Loaded once for all streams of a page; after a failure the next call tries again. */
export function loadUnpacking(load: () => Promise<SpeakerLibrary> = loadSpeakers): Promise<UnpackText> {
  unpacking ??= load().then((library) => {
    const plain = library.alloc(largestPlain);
    return (bytes) => {
      const size = withBytes(library, bytes, (packed, length) => library.functions.semblante_speaker_unpack(packed, length, plain, largestPlain));
      return size === 0 ? null : library.bytes.slice(plain, plain + size);
    };
  });
  unpacking.catch(() => (unpacking = null));
  return unpacking;
}

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
}

/** The part of libsemblante that has them: `semblante_speak.wasm`, which only pages that speak load. */
export type SpeakerLibrary = Runtime<SpeakerFunctions>;

export function loadSpeakers(): Promise<SpeakerLibrary> {
  return Runtime.open<SpeakerFunctions>(bytesOf(new URL('./semblante_speak.wasm', import.meta.url)));
}

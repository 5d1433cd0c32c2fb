import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { Runtime } from '../../../../clients/js/index.ts';
import { loadMotion, type Library } from '../../../../clients/js/motion/index.ts';
import type { SpeakerFunctions, SpeakerLibrary } from '../../../../clients/js/speech/library.ts';

const folder = process.env['SEMBLANTE_WASM'] ?? fileURLToPath(new URL('../../../../build/wasm', import.meta.url));

/** The C++ build makes them: target semblante-runtime-wasm. */
export const viewPath = join(folder, 'semblante_view.wasm');
export const motionPath = join(folder, 'semblante_motion.wasm');
export const wholePath = join(folder, 'semblante.wasm');
export const listenPath = join(folder, 'semblante_listen.wasm');
export const speakPath = join(folder, 'semblante_speak.wasm');

/** The library of this test file. */
export function loadRuntime(): Promise<Runtime> {
  return Runtime.load(() => readFileSync(viewPath));
}

/** Its part for takes, performances and bridges. */
export function loadLibrary(): Promise<Library> {
  return loadMotion(() => readFileSync(motionPath));
}

/** An instance of its part for the face of a client's own voice. */
export function loadSpeakers(): Promise<SpeakerLibrary> {
  return Runtime.open<SpeakerFunctions>(readFileSync(speakPath));
}

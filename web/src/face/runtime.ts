import { Runtime } from '@client/index.ts';
import { loadMotion, type Library } from '@client/motion/index.ts';
import type { SpeakerFunctions } from '@client/speech/library.ts';

/** The part of the client library that shows faces and follows streams, made once; after a failure the next call retries. */
export function loadRuntime(): Promise<Runtime> {
  return Runtime.load(() => fetch('./semblante_view.wasm'));
}

/** Its part for files and performances that are played on this page. Loaded when the first is. */
export function loadLibrary(): Promise<Library> {
  return loadMotion(() => fetch('./semblante_motion.wasm'));
}

/** Its part that unpacks the texts of a stream. Loaded before the first one comes, for which frames would wait. */
export async function prepareTexts(): Promise<void> {
  const { loadUnpacking } = await import('@client/speech/library.ts');
  await loadUnpacking(() => Runtime.open<SpeakerFunctions>(fetch('./semblante_speak.wasm')));
}

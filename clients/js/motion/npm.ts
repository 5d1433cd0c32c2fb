/** What the npm package exports as `semblante/motion`: takes, performances and bridges, with their file of the library. */
import { bytesOf } from '../wasm.ts';
import { loadMotion, type Library } from './library.ts';

export * from './index.ts';

/** Their part of the library, fetched and made once; after a failure the next call tries again. */
export function loadLibrary(): Promise<Library> {
  return loadMotion(() => bytesOf(new URL('./semblante_motion.wasm', import.meta.url)));
}

/** What the npm package exports as `semblante/motion`: takes, performances and bridges, with the file of the whole library. */
import { bytesOf } from '../wasm.ts';
import { loadWhole, type Library } from './library.ts';

export * from './index.ts';

/** The whole library, fetched and made once; after a failure the next call tries again. */
export function loadLibrary(): Promise<Library> {
  return loadWhole(() => bytesOf(new URL('./semblante.wasm', import.meta.url)));
}

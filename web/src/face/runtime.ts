import { Runtime } from '@client/index.ts';

/** The client library, fetched and made once; after a failure the next call retries. */
export function loadRuntime(): Promise<Runtime> {
  return Runtime.load(() => fetch('./semblante.wasm'));
}

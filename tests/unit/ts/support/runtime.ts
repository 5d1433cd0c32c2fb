import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { Runtime } from '../../../../clients/js/index.ts';

/** The C++ build makes it: target semblante-runtime-wasm. */
export const libraryPath =
  process.env['SEMBLANTE_WASM'] ?? fileURLToPath(new URL('../../../../build/wasm/semblante_view.wasm', import.meta.url));

/** The library of this test file. */
export function loadRuntime(): Promise<Runtime> {
  return Runtime.load(() => readFileSync(libraryPath));
}

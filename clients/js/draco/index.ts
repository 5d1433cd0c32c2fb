import makeDecoder from 'draco-decoder';
import type { DracoModule } from '../draco_mesh.ts';
import { bytesOf } from '../wasm.ts';

let decoder: Promise<DracoModule> | null = null;

/** The Draco decoder of this package, loaded at the first call; after a failure the next call retries. */
export function loadDraco(): Promise<DracoModule> {
  decoder ??= start();
  decoder.catch(() => (decoder = null));
  return decoder;
}

async function start(): Promise<DracoModule> {
  const wasmBinary = await bytesOf(new URL('./draco_decoder.wasm', import.meta.url));
  // The module has a `then` that resolves to itself: unwrapped, `await` would never finish.
  const { it } = await new Promise<{ it: DracoModule }>((resolve, reject) => {
    makeDecoder({ wasmBinary }).then((module) => {
      const bare = module as DracoModule & { then?: unknown };
      delete bare.then;
      resolve({ it: bare });
    }, reject);
  });
  return it;
}

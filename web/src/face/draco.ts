import type { DracoModule } from '@client/index.ts';

type MakeDecoder = (options: { locateFile: () => string }) => Promise<DracoModule>;

let decoder: Promise<DracoModule> | null = null;

/** The Draco decoder that is served with the page; loaded at its first use. */
export function dracoDecoder(): Promise<DracoModule> {
  decoder ??= start();
  decoder.catch(() => (decoder = null));
  return decoder;
}

/** The decoder is a classic script that defines one global function. */
async function start(): Promise<DracoModule> {
  const base = new URL('./draco/', document.baseURI).href;
  await new Promise<void>((resolve, reject) => {
    const script = document.createElement('script');
    script.src = `${base}draco_wasm_wrapper.js`;
    script.onload = () => resolve();
    script.onerror = () => reject(new Error('The Draco decoder could not be loaded from the server.'));
    document.head.append(script);
  });
  const make = (globalThis as unknown as { DracoDecoderModule: MakeDecoder }).DracoDecoderModule;
  // The module has a `then` that resolves to itself: unwrapped, `await` would never finish.
  const module = await new Promise<{ it: DracoModule }>((resolve, reject) => {
    make({ locateFile: () => `${base}draco_decoder.wasm` }).then((it) => {
      const bare = it as DracoModule & { then?: unknown };
      delete bare.then;
      resolve({ it: bare });
    }, reject);
  });
  return module.it;
}

/**
 * The file of libsemblante that shows faces and follows streams lies beside this one in the package; bundlers find it by the expression with `import.meta.url` and
 * take it along.
 */
import { Runtime } from './runtime.ts';

/** The library, fetched and made once for all faces, streams and players of a page; after a failure the next call retries. */
export function loadRuntime(): Promise<Runtime> {
  return Runtime.load(() => bytesOf(new URL('./semblante_view.wasm', import.meta.url)));
}

/** The bytes of a file of this package: by fetch, in Node from the disk, which its fetch does not read. */
export async function bytesOf(address: URL): Promise<Uint8Array<ArrayBuffer>> {
  if (address.protocol === 'file:') {
    const fileSystem = 'node:fs/promises'; // no bundler for a page shall look for it: see build.mjs
    const { readFile } = (await import(fileSystem)) as {
      readFile(path: URL): Promise<Uint8Array<ArrayBuffer>>;
    };
    return readFile(address);
  }
  const response = await fetch(address);
  const bytes = new Uint8Array(await response.arrayBuffer());
  if (response.ok && wasmMagic.every((byte, i) => bytes[i] === byte)) return bytes;
  const answer = response.ok ? 'a page, not WebAssembly' : `status ${response.status}`;
  throw new Error(`${address.href}: ${answer}. The bundler has left this file behind: see "Bundlers" in the README of semblante`);
}

/** The first bytes of every WebAssembly file. A development server may answer with its page, and success, for what it does not have. */
const wasmMagic = [0, 0x61, 0x73, 0x6d];

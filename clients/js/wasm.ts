/**
 * The kernel's WebAssembly module. The file lies beside this one in the package; bundlers find it by the expression with
 * `import.meta.url` and take it along.
 */
import { compileKernel } from './kernel.ts';

let compiled: Promise<WebAssembly.Module> | null = null;

/** The module of the package, fetched and compiled once for any number of faces; after a failure the next call retries. */
export function loadKernelModule(): Promise<WebAssembly.Module> {
  compiled ??= bytesOf(new URL('./semblante.wasm', import.meta.url)).then(compileKernel);
  compiled.catch(() => (compiled = null));
  return compiled;
}

/** The bytes of a file of this package: by fetch, in Node from the disk, which its fetch does not read. */
export async function bytesOf(address: URL): Promise<Uint8Array<ArrayBuffer>> {
  if (address.protocol === 'file:') {
    const fileSystem = 'node:fs/promises'; // no bundler for a page shall look for it
    const { readFile } = (await import(/* webpackIgnore: true */ /* @vite-ignore */ fileSystem)) as {
      readFile(path: URL): Promise<Uint8Array<ArrayBuffer>>;
    };
    return readFile(address);
  }
  const response = await fetch(address);
  if (!response.ok) throw new Error(`${address.href}: status ${response.status}`);
  return new Uint8Array(await response.arrayBuffer());
}

import { compileKernel } from '@client/index.ts';

let compiled: Promise<WebAssembly.Module> | null = null;

/** The WebAssembly kernel, fetched and compiled once; after a failure the next call retries. */
export function kernelModule(): Promise<WebAssembly.Module> {
  compiled ??= compileKernel(fetch('./kernel.wasm'));
  compiled.catch(() => (compiled = null));
  return compiled;
}

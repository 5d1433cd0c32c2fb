import { compileKernel } from '@client/index.ts';

let compiled: Promise<WebAssembly.Module> | null = null;

/** The WebAssembly kernel, fetched and compiled once; a failure is tried again by the next call. */
export function kernelModule(): Promise<WebAssembly.Module> {
  compiled ??= compileKernel(fetch('./kernel.wasm'));
  compiled.catch(() => (compiled = null));
  return compiled;
}

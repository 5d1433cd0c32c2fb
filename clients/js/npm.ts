/** What the npm package `semblante` exports: the SDK, with its own WebAssembly file. */
export * from './index.ts';
export { loadRuntime } from './wasm.ts';

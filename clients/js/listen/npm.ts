/** What the npm package exports as `semblante/listen`, with its files. */
import { bytesOf } from '../wasm.ts';
import type { ListenFiles } from './microphone.ts';

export * from './index.ts';

/** The files beside this one in the package. */
export const listenFiles: ListenFiles = {
  library: () => bytesOf(new URL('./semblante_listen.wasm', import.meta.url)),
  worklet: new URL('./listen_worklet.js', import.meta.url),
};

/** Google's decoder as the build takes it from three.js: one function that makes the module. */
declare module 'draco-decoder' {
  import type { DracoModule } from '../draco_mesh.ts';
  export default function makeDecoder(options: { wasmBinary: Uint8Array }): Promise<DracoModule>;
}

import { withBytes } from './bytes.ts';
import type { Runtime } from './runtime.ts';

const hashBytes = 32;

/**
 * SHA-256 as 64 lower-case hexadecimal digits, by libsemblante: pages outside a secure context (http on a local network)
 * have no Web Crypto.
 */
export function sha256(runtime: Runtime, bytes: Uint8Array): string {
  const digest = runtime.alloc(hashBytes);
  try {
    withBytes(runtime, bytes, (at, size) => runtime.functions.semblante_sha256(at, size, digest));
    const made = runtime.bytes.subarray(digest, digest + hashBytes);
    return Array.from(made, (byte) => byte.toString(16).padStart(2, '0')).join('');
  } finally {
    runtime.free(digest);
  }
}

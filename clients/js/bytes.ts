import type { StreamErrorCode } from '../../protocol/ts/generated/messages.ts';
import { ProtocolError } from '../../protocol/ts/protocol_error.ts';
import type { Memory, Refusal, Runtime } from './runtime.ts';

/** semblante_result, by number from 1. */
const codes: readonly StreamErrorCode[] = ['invalid_argument', 'malformed', 'unsupported', 'mismatch', 'too_large'];
/** SEMBLANTE_BUFFER_TOO_SMALL */
export const bufferTooSmall = 6;

/** What the library refuses in bytes from outside is a ProtocolError. */
export const refusedBytes: Refusal = (result, where, message) =>
  new ProtocolError(codes[result - 1] ?? 'internal', where, message);

/** Calls `use` with the address of a copy of the bytes, which is freed afterwards. */
export function withBytes<Result>(
  runtime: Runtime<Memory>,
  given: string | Uint8Array,
  use: (at: number, size: number) => Result,
): Result {
  const bytes = typeof given === 'string' ? new TextEncoder().encode(given) : given;
  const at = runtime.alloc(Math.max(1, bytes.length));
  try {
    runtime.bytes.set(bytes, at);
    return use(at, bytes.length);
  } finally {
    runtime.free(at);
  }
}

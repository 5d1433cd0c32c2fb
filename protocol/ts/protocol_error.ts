import type { StreamErrorCode } from './generated/messages.ts';

/** Someone else's bytes are not what they should be: what is wrong, where (JSON pointer or field), and in words. */
export class ProtocolError extends Error {
  readonly code: StreamErrorCode;
  readonly where: string;

  constructor(code: StreamErrorCode, where: string, message: string) {
    super(message);
    this.name = 'ProtocolError';
    this.code = code;
    this.where = where;
  }
}

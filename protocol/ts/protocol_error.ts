import type { StreamErrorCode } from './generated/messages.ts';

/** Untrusted bytes are invalid: `code` is the kind of error, `where` the JSON pointer or field. */
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

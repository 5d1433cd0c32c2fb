/** A face package, or the server that should give it, is not as it should be. */
export class FaceError extends Error {
  readonly code: 'malformed' | 'mismatch' | 'out_of_range' | 'not_finite' | 'http' | 'memory';
  /** HTTP status, for `http`. */
  readonly status: number | undefined;

  constructor(code: FaceError['code'], message: string, status?: number) {
    super(message);
    this.name = 'FaceError';
    this.code = code;
    this.status = status;
  }
}

/** A face package is malformed or inconsistent, or could not be fetched. */
export class FaceError extends Error {
  readonly code: 'malformed' | 'mismatch' | 'out_of_range' | 'not_finite' | 'http' | 'memory';
  /** HTTP status, for code `http`. */
  readonly status: number | undefined;

  constructor(code: FaceError['code'], message: string, status?: number) {
    super(message);
    this.name = 'FaceError';
    this.code = code;
    this.status = status;
  }
}

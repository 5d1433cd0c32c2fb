import { ProtocolError } from './protocol_error.ts';

const toUtf8 = new TextEncoder();

/** A position in a JSON value with its pointer. Each read checks type and range, or throws ProtocolError. */
export class JsonCursor {
  private readonly value: unknown;
  readonly pointer: string;

  constructor(value: unknown, pointer = '') {
    this.value = value;
    this.pointer = pointer;
  }

  fail(code: ProtocolError['code'], message: string): never {
    throw new ProtocolError(code, this.pointer, message);
  }

  get isNull(): boolean {
    return this.value === null;
  }

  get isText(): boolean {
    return typeof this.value === 'string';
  }

  get isArray(): boolean {
    return Array.isArray(this.value);
  }

  /** Throws ProtocolError `missing` when there is no such member. */
  member(name: string): JsonCursor {
    return this.optional(name) ?? new JsonCursor(null, this.child(name)).fail('missing', 'is required');
  }

  optional(name: string): JsonCursor | undefined {
    const object = this.object();
    return Object.hasOwn(object, name) ? new JsonCursor(object[name], this.child(name)) : undefined;
  }

  members(): [string, JsonCursor][] {
    return Object.entries(this.object()).map(([name, value]) => [name, new JsonCursor(value, this.child(name))]);
  }

  elements(least: number, most: number): JsonCursor[] {
    if (!Array.isArray(this.value)) this.fail('malformed', `must be an array, not ${this.kind()}`);
    const { length } = this.value;
    if (length < least || length > most) {
      const bounds = least === most ? `${least}` : `${least} to ${most}`;
      this.fail(length > most ? 'too_large' : 'out_of_range', `must have ${bounds} elements, not ${length}`);
    }
    return this.value.map((value: unknown, i) => new JsonCursor(value, `${this.pointer}/${i}`));
  }

  number(least = -Number.MAX_VALUE, most = Number.MAX_VALUE): number {
    if (typeof this.value !== 'number') this.fail('malformed', `must be a number, not ${this.kind()}`);
    if (!Number.isFinite(this.value)) this.fail('not_finite', 'must be finite');
    if (this.value < least || this.value > most) this.fail('out_of_range', `must be between ${least} and ${most}`);
    return this.value;
  }

  integer(least: number, most: number): number {
    const value = this.number();
    if (!Number.isInteger(value)) this.fail('malformed', 'must be a whole number');
    if (value < least || value > most) this.fail('out_of_range', `must be between ${least} and ${most}, not ${value}`);
    return value;
  }

  boolean(): boolean {
    if (typeof this.value !== 'boolean') this.fail('malformed', `must be true or false, not ${this.kind()}`);
    return this.value;
  }

  text(mostBytes: number): string {
    if (typeof this.value !== 'string') this.fail('malformed', `must be a string, not ${this.kind()}`);
    const bytes = this.value.length > mostBytes ? this.value.length : toUtf8.encode(this.value).length;
    if (bytes > mostBytes) this.fail('too_large', `must not exceed ${mostBytes} bytes`);
    return this.value;
  }

  private object(): Record<string, unknown> {
    if (typeof this.value !== 'object' || this.value === null || Array.isArray(this.value)) {
      this.fail('malformed', `must be an object, not ${this.kind()}`);
    }
    return this.value as Record<string, unknown>;
  }

  private child(name: string): string {
    return `${this.pointer}/${name.replaceAll('~', '~0').replaceAll('/', '~1')}`;
  }

  private kind(): string {
    if (this.value === null) return 'null';
    return Array.isArray(this.value) ? 'array' : typeof this.value;
  }
}

/** Parses a text that must be a JSON object. */
export function parseJsonObject(text: string, maxBytes: number): JsonCursor {
  if (text.length > maxBytes) throw new ProtocolError('too_large', '', `a JSON text has at most ${maxBytes} bytes`);
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (error) {
    throw new ProtocolError('malformed', '', `not JSON: ${(error as Error).message}`);
  }
  const cursor = new JsonCursor(value);
  cursor.members();
  return cursor;
}

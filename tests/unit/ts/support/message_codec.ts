import { ByteReader, ByteWriter, EndOfBytes, VarintTooLarge } from '../../../../protocol/ts/byte_io.ts';
import { isAppended, limits, messages, type Field, type Message } from '../../../../protocol/ts/messages.ts';
import { opusPacketMs } from '../../../../protocol/ts/opus_packet.ts';
import { isScoreOf } from '../../../../protocol/ts/speech_score.ts';
import { ProtocolError } from '../../../../protocol/ts/protocol_error.ts';

type Values = Record<string, unknown>;

const utf8 = new TextDecoder('utf-8', { fatal: true, ignoreBOM: true });
const toUtf8 = new TextEncoder();

function check(condition: boolean, what: string): asserts condition {
  if (!condition) throw new RangeError(what);
}

/** Whether a message carries a face. Those are packed, by libsemblante alone. */
export const hasFace = (message: { type: string }): boolean => message.type === 'keyframe' || message.type === 'frames';

/**
 * The binary form of a message without a face, as a server for tests; clients have libsemblante. Throws RangeError for a
 * message outside the documented ranges.
 */
export function encodeMessage(message: Message): Uint8Array {
  const description = messages.find((candidate) => candidate.name === message.type);
  check(description !== undefined && !hasFace(message), `no such message has the type ${message.type}`);
  const to = new ByteWriter();
  to.u8(description.type);
  // Trailing appended fields with default values are omitted, as writers of earlier versions omit them. The default
  // of each is one zero byte.
  let leftOut = 0;
  for (const field of description.fields) {
    const value = (message as unknown as Values)[field.name];
    if (isAppended(field) && value === field.fallback) {
      leftOut += 1;
      continue;
    }
    for (; leftOut > 0; --leftOut) to.u8(0);
    write(to, field, value);
  }
  return to.finish();
}

function write(to: ByteWriter, field: Field, value: unknown): void {
  switch (field.type) {
    case 'uint':
      check(Number.isInteger(value) && (value as number) >= 0 && (value as number) <= field.max, field.name);
      return to.varint(value as number);
    case 'real':
      check((value as number) >= field.min && (value as number) <= field.max, field.name);
      return to.f64(value as number);
    case 'bool':
      return to.u8(value === true ? 1 : 0);
    case 'text': {
      const bytes = toUtf8.encode(value as string);
      check(bytes.length <= field.max, field.name);
      to.varint(bytes.length);
      return to.append(bytes);
    }
    case 'bytes': {
      const bytes = value as Uint8Array;
      check(bytes.length <= field.max, field.name);
      to.varint(bytes.length);
      return to.append(bytes);
    }
    case 'reals': {
      const values = value as number[];
      check(values.length === 0 || values.length === field.length, field.name);
      to.varint(values.length);
      for (const each of values) {
        check(each >= field.min && each <= field.max, field.name);
        to.f64(each);
      }
      return;
    }
    case 'enum': {
      const index = field.values.names.indexOf(value as string);
      check(index >= 0, field.name);
      return to.u8(index);
    }
    case 'optional':
      to.u8(value === null ? 0 : 1);
      if (value !== null) for (const inner of field.fields) write(to, inner, (value as Values)[inner.name]);
      return;
    case 'optional_real':
      check((value as number) >= field.min && (value as number) <= field.max, field.name);
      to.u8(1);
      return to.f64(value as number);
    default:
      throw new RangeError(field.name);
  }
}

/**
 * Decodes a message without a face, independently of libsemblante. Throws ProtocolError: `unsupported` for every other
 * message, other codes for malformed bytes.
 */
export function decodeMessage(bytes: Uint8Array): Message {
  const type = bytes[0];
  if (type === undefined) throw new ProtocolError('truncated', '/type', 'the message is empty');
  if (bytes.length > limits.max_binary_message_bytes) throw new ProtocolError('too_large', '', 'over 256 KiB');
  const description = messages.find((candidate) => candidate.type === type);
  if (!description || hasFace({ type: description.name })) {
    throw new ProtocolError('unsupported', '/type', `no message without a face has the type ${type}`);
  }

  const from = new ByteReader(bytes.subarray(1));
  const values: Values = { type: description.name };
  for (const field of description.fields) values[field.name] = read(from, field, '');
  if (description.name === 'sound' && opusPacketMs(values.packet as Uint8Array) === null) {
    throw new ProtocolError('malformed', '/packet', 'is no Opus packet');
  }
  if (description.name === 'text' && !isScoreOf(values.score as Uint8Array, values.text as string)) {
    throw new ProtocolError('malformed', '/score', 'is no score of the text');
  }
  return values as unknown as Message; // bytes after the last field belong to a later version
}

function read(from: ByteReader, field: Field, prefix: string): unknown {
  const where = `${prefix}/${field.name}`;
  try {
    return readValue(from, field, where);
  } catch (error) {
    if (error instanceof EndOfBytes) {
      throw new ProtocolError('truncated', where, 'the message ends within this field');
    }
    if (error instanceof VarintTooLarge) throw new ProtocolError('out_of_range', where, 'a number beyond 2^53 - 1');
    throw error;
  }
}

function readValue(from: ByteReader, field: Field, where: string): unknown {
  if (isAppended(field) && from.remaining === 0) return field.fallback; // omitted by a writer of an earlier version
  switch (field.type) {
    case 'uint': {
      const value = from.varint();
      if (value > field.max) throw new ProtocolError('out_of_range', where, `must be at most ${field.max}`);
      return value;
    }
    case 'real':
      return readReal(from, field, where);
    case 'bool':
      return readFlag(from, where);
    case 'text': {
      const size = from.varint();
      if (size > field.max) throw new ProtocolError('too_large', where, `must not exceed ${field.max} bytes`);
      const bytes = from.take(size);
      try {
        return utf8.decode(bytes);
      } catch {
        throw new ProtocolError('malformed', where, 'must be UTF-8');
      }
    }
    case 'bytes': {
      const size = from.varint();
      if (size > field.max) throw new ProtocolError('too_large', where, `must not exceed ${field.max} bytes`);
      return from.take(size);
    }
    case 'reals': {
      const count = from.varint();
      if (count !== 0 && count !== field.length) {
        throw new ProtocolError('out_of_range', where, `must have 0 or ${field.length} elements`);
      }
      return Array.from({ length: count }, () => readReal(from, field, where));
    }
    case 'enum': {
      const value = from.u8();
      const name = field.values.names[value] ?? (field.values.open ? field.values.names[0] : undefined);
      if (name === undefined) throw new ProtocolError('out_of_range', where, 'not a known value');
      return name;
    }
    case 'optional': {
      if (!readFlag(from, where)) return null;
      const values: Values = {};
      for (const inner of field.fields) values[inner.name] = read(from, inner, where);
      return values;
    }
    case 'optional_real':
      return readFlag(from, where) ? readReal(from, field, where) : null;
    default:
      throw new RangeError(field.name);
  }
}

function readReal(from: ByteReader, field: { min: number; max: number }, where: string): number {
  const value = from.f64();
  if (!Number.isFinite(value)) throw new ProtocolError('not_finite', where, 'must be finite');
  if (value < field.min || value > field.max) throw new ProtocolError('out_of_range', where, 'outside its range');
  return value;
}

function readFlag(from: ByteReader, where: string): boolean {
  const value = from.u8();
  if (value > 1) throw new ProtocolError('malformed', where, 'must be 0 or 1');
  return value === 1;
}

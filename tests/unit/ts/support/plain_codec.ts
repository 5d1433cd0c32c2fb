import { ByteReader, ByteWriter, EndOfBytes, VarintTooLarge } from '../../../../protocol/ts/byte_io.ts';
import { copyFrame, neutralFrame, type FaceFrame, type TimedFrame } from '../../../../protocol/ts/face_frame.ts';
import {
  isAppended,
  limits,
  messages,
  type Field,
  type Message,
} from '../../../../protocol/ts/messages.ts';
import { ProtocolError } from '../../../../protocol/ts/protocol_error.ts';
import { readState, writeState } from './state_codec.ts';

type Values = Record<string, unknown>;

const utf8 = new TextDecoder('utf-8', { fatal: true, ignoreBOM: true });
const toUtf8 = new TextEncoder();

function check(condition: boolean, what: string): asserts condition {
  if (!condition) throw new RangeError(what);
}

/**
 * Encodes the messages of ONE stream in the plain binary form, as a server for tests; clients have libsemblante. It keeps the last frame, because a `frames` message contains
 * only differences: the decoder must receive every message in order, or a keyframe.
 */
export class FrameEncoder {
  private last: FaceFrame | null = null;
  private lastSequence = 0;

  /** Throws RangeError for a message outside the documented ranges, and for frames without a keyframe before them. */
  encode(message: Message): Uint8Array {
    const description = messages.find((candidate) => candidate.name === message.type);
    check(description !== undefined, `no message has the type ${message.type}`);
    if (message.type === 'frames') {
      check(this.last !== null, 'frames need a keyframe before them');
      check(message.sequence === 0 || message.sequence === this.lastSequence + 1, 'a gap in the sequence of frames');
    }
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
      this.write(to, field, value);
    }
    if (message.type === 'keyframe') {
      this.last = copyFrame(message.state);
      this.lastSequence = message.sequence;
    } else if (message.type === 'frames') {
      this.last = copyFrame(message.frames[message.frames.length - 1]!.state);
      this.lastSequence += message.frames.length;
    }
    return to.finish();
  }

  /** Drops the last frame: the next state must be a keyframe. */
  reset(): void {
    this.last = null;
  }

  private write(to: ByteWriter, field: Field, value: unknown): void {
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
        if (value !== null) for (const inner of field.fields) this.write(to, inner, (value as Values)[inner.name]);
        return;
      case 'optional_real':
        check((value as number) >= field.min && (value as number) <= field.max, field.name);
        to.u8(1);
        return to.f64(value as number);
      case 'state':
        return writeState(to, neutralFrame(), value as FaceFrame);
      case 'frames':
        return this.writeFrames(to, value as TimedFrame[]);
    }
  }

  private writeFrames(to: ByteWriter, frames: TimedFrame[]): void {
    check(frames.length > 0 && frames.length <= limits.max_frames_per_message, 'number of frames');
    to.varint(frames.length);
    let before = this.last!;
    let time = 0;
    for (const frame of frames) {
      check(Number.isInteger(frame.time) && frame.time >= time && frame.time <= limits.max_frame_time, 'time of a frame');
      to.varint(frame.time - time);
      writeState(to, before, frame.state);
      before = frame.state;
      time = frame.time;
    }
  }
}

/** Decodes the messages of ONE stream in the plain binary form, independently of libsemblante. */
export class FrameDecoder {
  /** The last frame of the plain form. */
  private last: FaceFrame | null = null;
  private lastSequence = 0;

  /**
   * Throws ProtocolError: `unsupported` for a message type of a later version (to be skipped), `mismatch` at
   * "/sequence" for frames before a keyframe or after a gap, other codes for malformed bytes. An error leaves the
   * decoder's state unchanged.
   */
  decode(bytes: Uint8Array): Message {
    const type = bytes[0];
    if (type === undefined) throw new ProtocolError('truncated', '/type', 'the message is empty');
    if (bytes.length > limits.max_binary_message_bytes) throw new ProtocolError('too_large', '', 'over 256 KiB');
    const description = messages.find((candidate) => candidate.type === type);
    if (!description) throw new ProtocolError('unsupported', '/type', `no message has the type ${type}`);

    const from = new ByteReader(bytes.subarray(1));
    const values: Values = { type: description.name };
    for (const field of description.fields) values[field.name] = this.read(from, field, '');
    const message = values as unknown as Message; // bytes after the last field belong to a later version
    if (message.type === 'keyframe') {
      this.last = copyFrame(message.state);
      this.lastSequence = message.sequence;
    } else if (message.type === 'frames') {
      const next = this.lastSequence + 1;
      if (message.sequence === 0) message.sequence = next;
      if (message.sequence !== next) {
        throw new ProtocolError('mismatch', '/sequence', `frame ${next} is expected, not ${message.sequence}`);
      }
      this.last = copyFrame(message.frames[message.frames.length - 1]!.state);
      this.lastSequence += message.frames.length;
    }
    return message;
  }

  reset(): void {
    this.last = null;
  }

  private read(from: ByteReader, field: Field, prefix: string): unknown {
    const where = `${prefix}/${field.name}`;
    try {
      return this.readValue(from, field, where);
    } catch (error) {
      if (error instanceof EndOfBytes) {
        throw new ProtocolError('truncated', where, 'the message ends within this field');
      }
      if (error instanceof VarintTooLarge) throw new ProtocolError('out_of_range', where, 'a number beyond 2^53 - 1');
      throw error;
    }
  }

  private readValue(from: ByteReader, field: Field, where: string): unknown {
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
        for (const inner of field.fields) values[inner.name] = this.read(from, inner, where);
        return values;
      }
      case 'optional_real':
        return readFlag(from, where) ? readReal(from, field, where) : null;
      case 'state': {
        const state = neutralFrame();
        readState(from, state, where);
        return state;
      }
      case 'frames':
        return this.readFrames(from, where);
    }
  }

  private readFrames(from: ByteReader, where: string): TimedFrame[] {
    if (this.last === null) throw new ProtocolError('mismatch', '/sequence', 'frames before a keyframe');
    const count = from.varint();
    if (count === 0) throw new ProtocolError('out_of_range', where, 'must have at least one frame');
    if (count > limits.max_frames_per_message) throw new ProtocolError('too_large', where, 'too many frames in a message');
    const frames: TimedFrame[] = [];
    let state = this.last;
    let time = 0;
    for (let i = 0; i < count; ++i) {
      time += from.varint();
      if (time > limits.max_frame_time) {
        throw new ProtocolError('out_of_range', `${where}/${i}/time`, 'more than a day after media_time');
      }
      state = copyFrame(state);
      readState(from, state, `${where}/${i}`);
      frames.push({ time, state });
    }
    return frames;
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

import { ByteReader, ByteWriter, EndOfBytes, VarintTooLarge } from './byte_io.ts';
import { copyFrame, neutralFrame, type FaceFrame, type TimedFrame } from './face_frame.ts';
import { limits, packedFramesType, packedKeyframeType, type Frames, type Keyframe } from './generated/messages.ts';
import { copyPacked, PackedModel, packedStart, type PackedState } from './packed_model.ts';
import { ProtocolError } from './protocol_error.ts';
import { RangeDecoder, RangeEncoder } from './range_coder.ts';
import { checkState } from './state_codec.ts';

/** The packed form of keyframes and frames: predicted and entropy coded. SPEC.md, "Packed form". */

/** Encodes a stream in the packed form. */
export class PackedEncoder {
  private state: PackedState;

  /** `start`: the state before the first frame (default: the neutral face). */
  constructor(start: Omit<Keyframe, 'type'> = { sequence: 0, media_time: 0, state: neutralFrame() }) {
    checkState(start.state);
    this.state = packedStart(start.state, start.sequence, start.media_time);
  }

  /** Throws RangeError for frames outside the documented ranges and for a gap (`sequence` 0 means the next). */
  encode(message: Frames): Uint8Array {
    check(message.sequence === 0 || message.sequence === this.state.sequence + 1, 'a gap in the sequence of frames');
    const { frames } = message;
    check(frames.length > 0 && frames.length <= limits.max_frames_per_message, 'number of frames');
    check(Number.isSafeInteger(message.media_time) && message.media_time >= 0, 'media_time');
    let time = 0;
    for (const frame of frames) {
      check(Number.isInteger(frame.time) && frame.time >= time && frame.time <= limits.max_frame_time, 'time of a frame');
      checkState(frame.state);
      time = frame.time;
    }
    const state = copyPacked(this.state);
    const bytes = [packedFramesType + ((state.sequence + 1) % 128)];
    const coder = new RangeEncoder(bytes);
    const model = new PackedModel(coder, state);
    model.count(frames.length);
    model.baseTime(message.media_time);
    model.offset(frames[0]!.time);
    frames.forEach((frame, i) => {
      if (i > 0) model.step(frame.time - frames[i - 1]!.time);
      model.frame(frame.state);
    });
    coder.finish();
    state.sequence += frames.length;
    state.fresh = false;
    this.state = state;
    return Uint8Array.from(bytes);
  }

  /** A keyframe: the newest frame and the codec state that a decoder needs for the next result of encode(). */
  keyframe(): Uint8Array {
    const to = new ByteWriter();
    to.u8(packedKeyframeType);
    to.varint(this.state.sequence);
    to.varint(this.state.mediaTime);
    const bytes = [...to.finish()];
    const coder = new RangeEncoder(bytes);
    new PackedModel(coder, packedStart()).history(this.state);
    coder.finish();
    return Uint8Array.from(bytes);
  }
}

/**
 * Decodes the messages of ONE packed stream, including the type byte, from untrusted bytes. Throws ProtocolError with
 * the pointer of the plain form; an error leaves the state unchanged.
 */
export class PackedDecoder {
  private state: PackedState | null = null;

  keyframe(bytes: Uint8Array): Keyframe {
    const state = packedStart();
    const from = new ByteReader(bytes.subarray(1));
    state.sequence = readNumber(from, '/sequence');
    const mediaTime = readNumber(from, '/media_time');
    const coder = new RangeDecoder(from.take(from.remaining));
    const model = new PackedModel(coder, state);
    model.history(packedStart());
    state.mediaTime = mediaTime;
    checkRead(coder, model, '/state');
    checkEnd(coder, '/state');
    this.state = state;
    return { type: 'keyframe', sequence: state.sequence, media_time: mediaTime, state: copyFrame(state.before[0]!) };
  }

  frames(bytes: Uint8Array): Frames {
    if (this.state === null) throw new ProtocolError('mismatch', '/sequence', 'packed frames before a packed keyframe');
    const next = this.state.sequence + 1;
    if (bytes[0]! % 128 !== next % 128) throw new ProtocolError('mismatch', '/sequence', `frame ${next} is expected`);
    const state = copyPacked(this.state);
    const coder = new RangeDecoder(bytes.subarray(1));
    const model = new PackedModel(coder, state);
    const count = model.count(0);
    const mediaTime = model.baseTime(0);
    let time = model.offset(0);
    checkRead(coder, model, '');
    const unknown: FaceFrame = neutralFrame();
    const frames: TimedFrame[] = [];
    for (let i = 0; i < count; i += 1) {
      const where = `/frames/${i}`;
      if (i > 0) time += model.step(0);
      if (time > limits.max_frame_time) {
        throw new ProtocolError('out_of_range', `${where}/time`, 'more than a day after media_time');
      }
      frames.push({ time, state: copyFrame(model.frame(unknown)) });
      checkRead(coder, model, where);
    }
    checkEnd(coder, '/frames');
    state.sequence += count;
    state.fresh = false;
    this.state = state;
    return { type: 'frames', sequence: next, media_time: mediaTime, frames };
  }
}

function readNumber(from: ByteReader, where: string): number {
  try {
    return from.varint();
  } catch (error) {
    if (error instanceof EndOfBytes) throw new ProtocolError('truncated', where, 'the message ends within this field');
    if (error instanceof VarintTooLarge) throw new ProtocolError('out_of_range', where, 'a number beyond 2^53 - 1');
    throw error;
  }
}

function checkRead(coder: RangeDecoder, model: PackedModel, where: string): void {
  if (!coder.valid) throw new ProtocolError('malformed', where, 'is not the start of a packed message');
  if (coder.truncated) throw new ProtocolError('truncated', where, 'the message ends within a packed state');
  if (model.fault !== '') throw new ProtocolError('out_of_range', where + model.fault, 'outside its range');
}

function checkEnd(coder: RangeDecoder, where: string): void {
  if (coder.hasMore) throw new ProtocolError('malformed', where, 'bytes after the end');
}

function check(condition: boolean, what: string): asserts condition {
  if (!condition) throw new RangeError(what);
}

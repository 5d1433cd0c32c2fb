import { describe, expect, it } from 'vitest';
import {
  decodeJson,
  encodeJson,
  FrameDecoder,
  FrameEncoder,
  neutralFrame,
  PackedEncoder,
  ProtocolError,
  type Frames,
  type Message,
} from '../../../../protocol/ts/index.ts';
import { fromHex, toHex, vectorJson } from './vectors.ts';

interface Vector {
  binary: string;
  json: Record<string, unknown>;
}
const { streams } = vectorJson('packed.json') as { streams: { name: string; messages: Vector[] }[] };
const { refused } = vectorJson('packed_refused.json') as {
  refused: { name: string; before: string[]; binary: string; code: string; where: string }[];
};

const keyframe = (sequence = 0, state = neutralFrame()): Message => ({ type: 'keyframe', sequence, media_time: 0, state });
const frames = (sequence: number, level = 0): Frames => {
  const state = neutralFrame();
  state.levels[3] = level;
  return { type: 'frames', sequence, media_time: 40 * sequence, frames: [{ time: 0, state }] };
};

function errorOf(run: () => unknown): ProtocolError {
  try {
    run();
  } catch (error) {
    if (error instanceof ProtocolError) return error;
    throw error;
  }
  throw new Error('was not refused');
}

describe('golden packed streams', () => {
  it.each(streams)('Decode_IsTheJson: $name', ({ messages }) => {
    const readers: FrameDecoder[] = [];
    for (const { binary, json } of messages) {
      const meant = decodeJson(JSON.stringify(json));
      if (meant.type === 'keyframe') readers.push(new FrameDecoder()); // who joins here
      const mine = meant.type === 'keyframe' ? readers.slice(-1) : readers;
      for (const reader of mine) expect(reader.decode(fromHex(binary))).toEqual(meant);
    }
  });

  it.each(streams)('Encode_IsTheBinary: $name', ({ messages }) => {
    const meant = messages.map(({ json }) => decodeJson(JSON.stringify(json)));
    const first = meant[0]!;
    if (first.type !== 'keyframe') throw new Error(first.type);
    const encoder = new PackedEncoder(first);
    for (const [i, message] of meant.entries()) {
      const bytes = message.type === 'frames' ? encoder.encode(message) : encoder.keyframe();
      expect(toHex(bytes)).toBe(messages[i]!.binary);
    }
  });

  it.each(refused)('Decode_Invalid_IsRefused: $name', ({ before, binary, code, where }) => {
    const decoder = new FrameDecoder();
    for (const each of before) decoder.decode(fromHex(each));
    const error = errorOf(() => decoder.decode(fromHex(binary)));
    expect({ code: error.code, where: error.where }).toEqual({ code, where });
  });
});

describe('packed frames', () => {
  it('Decode_EveryPrefixAndFlippedBit_IsRefusedOrValid', () => {
    let cases = 0;
    for (const { messages } of streams.slice(2, 4)) {
      for (const [index, { binary }] of messages.slice(0, 4).entries()) {
        const good = fromHex(binary);
        const damaged = Array.from({ length: good.length }, (_, size) => good.subarray(0, size));
        for (let bit = 0; bit < good.length * 8; bit += 1) {
          const bytes = good.slice();
          bytes[bit >> 3]! ^= 1 << (bit & 7);
          damaged.push(bytes);
        }
        const decoder = new FrameDecoder();
        for (const before of messages.slice(0, index)) decoder.decode(fromHex(before.binary));
        for (const bytes of damaged) {
          const copy = new FrameDecoder();
          for (const before of messages.slice(0, index)) copy.decode(fromHex(before.binary));
          let message: Message;
          try {
            message = copy.decode(bytes);
          } catch (error) {
            expect(error).toBeInstanceOf(ProtocolError);
            continue;
          }
          decodeJson(encodeJson(message)); // strict about ranges
          cases += 1;
        }
        decoder.decode(good);
      }
    }
    expect(cases).toBeGreaterThan(0);
  });

  it('RoundTrip_RandomFaces_IsLossless', () => {
    let seed = 5;
    const random = (below: number): number => (seed = (seed * 48271) % 0x7fffffff) % below;
    const encoder = new PackedEncoder();
    const decoder = new FrameDecoder();
    decoder.decode(encoder.keyframe());
    const state = neutralFrame();
    for (let i = 1; i < 600; i += 1) {
      for (let k = 0; k < 4; k += 1) state.levels[3 + random(66)] = random(3) === 0 ? random(65535) - 32767 : random(9);
      state.viseme = { select1: random(15), select2: random(15), blend: random(64) };
      state.expression = { select1: random(7), intensity1: random(64), select2: random(7), intensity2: random(64) };
      const message: Frames = { type: 'frames', sequence: i, media_time: random(1e9) * 4e6, frames: [{ time: random(50), state }] };
      expect(decoder.decode(encoder.encode(message))).toEqual(message);
    }
  });

  it('Decode_OtherFormThanTheKeyframe_IsRefused', () => {
    const packed = new PackedEncoder();
    const plain = new FrameEncoder();
    const decoder = new FrameDecoder();
    const starts = { packed: packed.keyframe(), plain: plain.encode(keyframe()) };
    const batches = { packed: packed.encode(frames(1)), plain: plain.encode(frames(1)) };
    expect(errorOf(() => decoder.decode(batches.packed)).code).toBe('mismatch');
    decoder.decode(starts.plain);
    expect(errorOf(() => decoder.decode(batches.packed)).code).toBe('mismatch');
    decoder.decode(starts.packed);
    expect(errorOf(() => decoder.decode(batches.plain)).code).toBe('mismatch');
    expect(decoder.decode(batches.packed)).toEqual(frames(1));
    expect(errorOf(() => decoder.decode(batches.packed)).where).toBe('/sequence');
  });

  it('Decode_GivesFramesOfTheirOwn', () => {
    const encoder = new PackedEncoder();
    const decoder = new FrameDecoder();
    const first = decoder.decode(encoder.keyframe());
    if (first.type !== 'keyframe') throw new Error(first.type);
    first.state.levels[3] = 99; // what a reader does with its frame is not the decoder's
    expect(decoder.decode(encoder.encode(frames(1, 5)))).toEqual(frames(1, 5));
  });

  it('Encode_OutOfRange_ThrowsAndForgetsNothing', () => {
    const encoder = new PackedEncoder();
    const decoder = new FrameDecoder();
    decoder.decode(encoder.keyframe());
    expect(() => encoder.encode(frames(2))).toThrow(RangeError);
    expect(() => encoder.encode({ ...frames(1), frames: [] })).toThrow(RangeError);
    expect(() => encoder.encode({ ...frames(1), media_time: 0.5 })).toThrow(RangeError);
    const bad = frames(1);
    bad.frames[0]!.state.viseme.select1 = 15;
    expect(() => encoder.encode(bad)).toThrow(RangeError);
    expect(decoder.decode(encoder.encode(frames(1, 7)))).toEqual(frames(1, 7));
  });
});

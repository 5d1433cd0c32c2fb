import { describe, expect, it } from 'vitest';
import {
  decodeJson,
  encodeJson,
  neutralFrame,
  ProtocolError,
  quantize,
  quantizersOf,
  standardQuantizers,
  type Header,
  type Message,
} from '../../../../protocol/ts/index.ts';
import { fromHex, toHex, vectorJson } from '../protocol/vectors.ts';
import { FrameDecoder, FrameEncoder } from './plain_codec.ts';

interface Vector {
  name: string;
  binary: string;
  json: Record<string, unknown>;
}
const vectors = (vectorJson('messages.json') as { messages: Vector[] }).messages;
const appended = vectorJson('appended_fields.json') as {
  messages: Vector[];
  reads_as_absent: string;
  reads_as_default: { as: string; binary: string }[];
};
interface Refused {
  name: string;
  binary?: string;
  json?: string;
  code: string;
  where: string;
}
const refused = (vectorJson('refused.json') as { refused: Refused[] }).refused;

function decoderAfterNeutralKeyframe(): FrameDecoder {
  const decoder = new FrameDecoder();
  decoder.decode(new FrameEncoder().encode({ type: 'keyframe', sequence: 0, media_time: 0, state: neutralFrame() }));
  return decoder;
}

function errorOf(run: () => unknown): ProtocolError {
  try {
    run();
  } catch (error) {
    if (error instanceof ProtocolError) return error;
    throw error;
  }
  throw new Error('was not refused');
}

describe('FrameDecoder', () => {
  it.each(refused.filter((each) => each.binary !== undefined))('Decode_Invalid_IsRefused: $name', (each) => {
    const error = errorOf(() => decoderAfterNeutralKeyframe().decode(fromHex(each.binary!)));
    expect({ code: error.code, where: error.where }).toEqual({ code: each.code, where: each.where });
  });

  it('Decode_FramesBeforeAKeyframe_AreRefused', () => {
    expect(errorOf(() => new FrameDecoder().decode(fromHex('040100010000'))).code).toBe('mismatch');
  });

  it('Decode_EveryPrefix_IsRefusedAsTruncated', () => {
    const decoder = new FrameDecoder();
    for (const { binary } of vectors) {
      const good = fromHex(binary);
      for (let size = 0; size < good.length; ++size) {
        expect(errorOf(() => decoder.decode(good.subarray(0, size))).code).toBe('truncated');
      }
      decoder.decode(good);
    }
  });

  it('Decode_EveryFlippedBit_IsRefusedOrValid', async () => {
    // The test runner gives up on a worker that does not answer for a minute, which on a busy machine this loop takes.
    const letTheRunnerIn = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));
    for (const [index, { binary }] of vectors.entries()) {
      const good = fromHex(binary);
      for (let bit = 0; bit < good.length * 8; ++bit) {
        if (bit % 256 === 0) await letTheRunnerIn();
        const bytes = good.slice();
        bytes[bit >> 3]! ^= 1 << (bit & 7);
        const decoder = new FrameDecoder();
        for (const before of vectors.slice(0, index)) decoder.decode(fromHex(before.binary));
        let message: Message;
        try {
          message = decoder.decode(bytes);
        } catch (error) {
          expect(error).toBeInstanceOf(ProtocolError);
          continue;
        }
        decodeJson(encodeJson(message)); // strict about ranges
      }
    }
  });

  it('Decode_RandomBytes_IsRefusedOrValid', () => {
    let seed = 1;
    const random = (): number => (seed = (seed * 48271) % 0x7fffffff);
    const decoder = decoderAfterNeutralKeyframe();
    for (let round = 0; round < 5000; ++round) {
      const bytes = Uint8Array.from({ length: 1 + (random() % 60) }, () => (random() % 4 === 0 ? random() : random() % 8));
      try {
        decoder.decode(bytes);
      } catch (error) {
        expect(error).toBeInstanceOf(ProtocolError);
      }
    }
  });

  it('Decode_BytesOfALaterVersion_AreSkipped', () => {
    const decoder = new FrameDecoder();
    const plain = new FrameDecoder();
    for (const { binary, json } of vectors) {
      const appends = json['type'] === 'header' || json['type'] === 'hello'; // two fields of their own
      const unknown = appends ? '0000010203' : '010203';
      expect(decoder.decode(fromHex(binary + unknown))).toEqual(plain.decode(fromHex(binary)));
    }
  });

  it('Decode_AfterAnError_GoesOnFromTheLastGoodState', () => {
    const decoder = decoderAfterNeutralKeyframe();
    expect(errorOf(() => decoder.decode(fromHex('0402000100' + '00'))).where).toBe('/sequence');
    expect(decoder.decode(fromHex('040100010000'))).toMatchObject({ type: 'frames', sequence: 1 });
  });
});

describe('golden messages', () => {
  const encoder = new FrameEncoder();
  const decoder = new FrameDecoder();
  it.each(vectors)('$name', ({ binary, json }) => {
    const fromText = decodeJson(JSON.stringify(json));
    expect(decoder.decode(fromHex(binary))).toEqual(fromText);
    expect(toHex(encoder.encode(fromText))).toBe(binary);
    expect(JSON.parse(encodeJson(fromText))).toEqual(json);
  });
});

describe('golden messages with appended fields', () => {
  it.each(appended.messages)('$name', ({ binary, json }) => {
    const fromText = decodeJson(JSON.stringify(json));
    expect(fromText).toMatchObject({ coding: json['coding'] ?? 'plain' });
    if (fromText.type === 'header') expect(fromText.viseme_share).toBe(json['viseme_share'] ?? null);
    if (fromText.type === 'hello') expect(fromText.take_over).toBe(json['take_over'] ?? false);
    expect(new FrameDecoder().decode(fromHex(binary))).toEqual(fromText);
    expect(toHex(new FrameEncoder().encode(fromText))).toBe(binary);
    expect(JSON.parse(encodeJson(fromText))).toEqual(json);
  });

  it.each(appended.reads_as_default)('Decode_DefaultWritten_IsDefault: $binary', ({ as, binary }) => {
    const meant = appended.messages.find((each) => each.name === as)!;
    expect(new FrameDecoder().decode(fromHex(binary))).toEqual(decodeJson(JSON.stringify(meant.json)));
  });

  it('Decode_FlagOfNothing_IsAbsent', () => {
    expect(new FrameDecoder().decode(fromHex(appended.reads_as_absent))).toMatchObject({ viseme_share: null });
  });

  it('Encode_ShareOutOfRange_Throws', () => {
    const header = decodeJson(JSON.stringify(appended.messages[1]!.json)) as Header;
    for (const share of [-0.1, 1.1, NaN]) {
      expect(() => new FrameEncoder().encode({ ...header, viseme_share: share })).toThrow(RangeError);
    }
  });
});

describe('FrameEncoder', () => {
  it('Encode_FramesWithoutAKeyframe_Throws', () => {
    const frames: Message = { type: 'frames', sequence: 1, media_time: 0, frames: [{ time: 0, state: neutralFrame() }] };
    expect(() => new FrameEncoder().encode(frames)).toThrow(RangeError);
  });

  it('Encode_OutOfRange_Throws', () => {
    const state = neutralFrame();
    state.viseme.select1 = 15;
    expect(() => new FrameEncoder().encode({ type: 'keyframe', sequence: 0, media_time: 0, state })).toThrow(RangeError);
    expect(() => new FrameEncoder().encode({ type: 'end', reason: 'bored' as never })).toThrow(RangeError);
    expect(() => new FrameEncoder().encode({ type: 'ping', id: -1, client_time: 0 })).toThrow(RangeError);
    expect(() => new FrameEncoder().encode({ type: 'ping', id: 0, client_time: NaN })).toThrow(RangeError);
  });

  it('RoundTrip_LongTalk_IsLossless', () => {
    const encoder = new FrameEncoder();
    const decoder = new FrameDecoder();
    const state = neutralFrame();
    decoder.decode(encoder.encode({ type: 'keyframe', sequence: 0, media_time: 0, state }));
    let seed = 5;
    const random = (): number => (seed = (seed * 48271) % 0x7fffffff);
    for (let i = 1; i < 2000; ++i) {
      for (let k = 0; k < 4; ++k) state.levels[3 + (random() % 66)] = (random() % 65535) - 32767;
      state.viseme.select1 = random() % 15;
      const message: Message = { type: 'frames', sequence: i, media_time: i * 40, frames: [{ time: 0, state }] };
      expect(decoder.decode(encoder.encode(message))).toEqual(message);
    }
  });
});

describe('JSON', () => {
  it.each(refused.filter((each) => each.json !== undefined))('Decode_Invalid_IsRefused: $name', (each) => {
    const error = errorOf(() => decodeJson(each.json!));
    expect({ code: error.code, where: error.where }).toEqual({ code: each.code, where: each.where });
  });

  it('Decode_LeftOutMembers_HaveTheirDefaults', () => {
    const message = decodeJson('{"type":"frames","frames":[{"viseme":{"select1":10}},{"time":40,"faps":{"3":200}}]}');
    if (message.type !== 'frames') throw new Error(message.type);
    expect(message.frames[0]!.state.viseme).toEqual({ select1: 10, select2: 0, blend: 63 });
    expect(message.frames[1]!.state.viseme).toEqual({ select1: 0, select2: 0, blend: 0 });
    expect(message.frames[1]!.state.levels[3]).toBe(50);
  });

  it('Decode_FinerSteps_UsesTheStreams', () => {
    const header = { quantizers: new Array<number>(66).fill(0.25) } as Header;
    const steps = quantizersOf(header);
    const message = decodeJson('{"type":"keyframe","state":{"faps":{"3":10.26}}}', steps);
    expect(message).toMatchObject({ state: { levels: expect.objectContaining({ 3: 41 }) as unknown } });
    expect(JSON.parse(encodeJson(message, steps))).toMatchObject({ state: { faps: { 3: 10.25 } } });
  });
});

describe('quantizersOf', () => {
  it('QuantizersOf_StandardSteps_AreTheSameLeftOutOrWrittenOut', () => {
    const headers = vectors
      .filter(({ name }) => name.startsWith('header with the standard steps'))
      .map(({ binary }) => new FrameDecoder().decode(fromHex(binary)) as Header);
    expect(headers.map(({ quantizers }) => quantizers.length)).toEqual([0, 66]);
    for (const header of headers) expect(quantizersOf(header)).toEqual(standardQuantizers);
  });
});

describe('quantize', () => {
  it('Quantize_RoundsHalvesAwayFromZero', () => {
    expect([2, -2, 1.9, 32767.4].map((value) => quantize(value, value > 100 ? 1 : 4))).toEqual([1, -1, 0, 32767]);
    expect(quantize(32767.5, 1)).toBeNull();
    expect(quantize(NaN, 1)).toBeNull();
    expect(quantize(-Infinity, 1)).toBeNull();
    expect(standardQuantizers[3]).toBe(4);
  });
});

import { describe, expect, it } from 'vitest';
import {
  decodeJson,
  encodeJson,
  opusPacketMs,
  ProtocolError,
  quantize,
  quantizersOf,
  standardQuantizers,
  type Header,
  type Message,
} from '../../../../protocol/ts/index.ts';
import { fromHex, toHex, vectorJson } from '../protocol/vectors.ts';
import { decodeMessage, encodeMessage, hasFace } from './message_codec.ts';

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
const sound = vectorJson('sound.json') as { messages: (Vector & { lasts?: number })[]; refused: Refused[] };
const text = vectorJson('text.json') as { messages: Vector[]; refused: Refused[] };
const refused = [...(vectorJson('refused.json') as { refused: Refused[] }).refused, ...sound.refused, ...text.refused];

const faceless = [...vectors.filter(({ json }) => !hasFace(json as { type: string })), ...sound.messages.filter(({ json }) => json['type'] === 'sound'), ...text.messages.filter(({ json }) => json['type'] !== 'hello')];

function errorOf(run: () => unknown): ProtocolError {
  try {
    run();
  } catch (error) {
    if (error instanceof ProtocolError) return error;
    throw error;
  }
  throw new Error('was not refused');
}

describe('decodeMessage', () => {
  it.each(refused.filter((each) => each.binary !== undefined))('Decode_Invalid_IsRefused: $name', (each) => {
    const error = errorOf(() => decodeMessage(fromHex(each.binary!)));
    expect({ code: error.code, where: error.where }).toEqual({ code: each.code, where: each.where });
  });

  it('Decode_EveryPrefix_IsRefusedAsTruncated', () => {
    for (const { binary } of faceless) {
      const good = fromHex(binary);
      for (let size = 0; size < good.length; ++size) {
        expect(errorOf(() => decodeMessage(good.subarray(0, size))).code).toBe('truncated');
      }
    }
  });

  it('Decode_EveryFlippedBit_IsRefusedOrValid', async () => {
    // The test runner gives up on a worker that does not answer for a minute, which on a busy machine this loop takes.
    const letTheRunnerIn = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));
    for (const { binary } of faceless) {
      const good = fromHex(binary);
      for (let bit = 0; bit < good.length * 8; ++bit) {
        if (bit % 256 === 0) await letTheRunnerIn();
        const bytes = good.slice();
        bytes[bit >> 3]! ^= 1 << (bit & 7);
        let message: Message;
        try {
          message = decodeMessage(bytes);
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
    for (let round = 0; round < 5000; ++round) {
      const bytes = Uint8Array.from({ length: 1 + (random() % 60) }, () => (random() % 4 === 0 ? random() : random() % 8));
      try {
        decodeMessage(bytes);
      } catch (error) {
        expect(error).toBeInstanceOf(ProtocolError);
      }
    }
  });

  it('Decode_BytesOfALaterVersion_AreSkipped', () => {
    for (const { binary, json } of faceless) {
      const appends = json['type'] === 'header' || json['type'] === 'hello'; // a field of their own
      const unknown = appends ? '00000000010203' : '010203';
      expect(decodeMessage(fromHex(binary + unknown))).toEqual(decodeMessage(fromHex(binary)));
    }
  });
});

describe('golden messages', () => {
  it.each(vectors)('$name', ({ binary, json }) => {
    const fromText = decodeJson(JSON.stringify(json));
    if (!hasFace(fromText)) {
      expect(decodeMessage(fromHex(binary))).toEqual(fromText);
      expect(toHex(encodeMessage(fromText))).toBe(binary);
    }
    expect(JSON.parse(encodeJson(fromText))).toEqual(json);
  });
});

describe('golden messages about sound', () => {
  it.each(sound.messages)('$name', ({ binary, json, lasts }) => {
    const fromText = decodeJson(JSON.stringify(json));
    expect(decodeMessage(fromHex(binary))).toEqual(fromText);
    expect(toHex(encodeMessage(fromText))).toBe(binary);
    expect(JSON.parse(encodeJson(fromText))).toEqual(json);
    if (fromText.type === 'sound') expect(opusPacketMs(fromText.packet)).toBe(lasts);
  });
});

describe('golden messages with appended fields', () => {
  it.each(appended.messages)('$name', ({ binary, json }) => {
    const fromText = decodeJson(JSON.stringify(json));
    if (fromText.type === 'header') expect(fromText.viseme_share).toBe(json['viseme_share'] ?? null);
    if (fromText.type === 'hello') expect(fromText.take_over).toBe(json['take_over'] ?? false);
    expect(decodeMessage(fromHex(binary))).toEqual(fromText);
    expect(toHex(encodeMessage(fromText))).toBe(binary);
    expect(JSON.parse(encodeJson(fromText))).toEqual(json);
  });

  it.each(appended.reads_as_default)('Decode_DefaultWritten_IsDefault: $binary', ({ as, binary }) => {
    const meant = appended.messages.find((each) => each.name === as)!;
    expect(decodeMessage(fromHex(binary))).toEqual(decodeJson(JSON.stringify(meant.json)));
  });

  it('Decode_FlagOfNothing_IsAbsent', () => {
    expect(decodeMessage(fromHex(appended.reads_as_absent))).toMatchObject({ viseme_share: null });
  });

  it('Encode_ShareOutOfRange_Throws', () => {
    const header = decodeJson(JSON.stringify(appended.messages[1]!.json)) as Header;
    for (const share of [-0.1, 1.1, NaN]) {
      expect(() => encodeMessage({ ...header, viseme_share: share })).toThrow(RangeError);
    }
  });
});

describe('encodeMessage', () => {
  it('Encode_OutOfRange_Throws', () => {
    expect(() => encodeMessage({ type: 'end', reason: 'bored' as never })).toThrow(RangeError);
    expect(() => encodeMessage({ type: 'ping', id: -1, client_time: 0 })).toThrow(RangeError);
    expect(() => encodeMessage({ type: 'ping', id: 0, client_time: NaN })).toThrow(RangeError);
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
      .map(({ binary }) => decodeMessage(fromHex(binary)) as Header);
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

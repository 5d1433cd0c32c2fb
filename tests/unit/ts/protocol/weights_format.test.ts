import { deflateSync, inflateSync } from 'node:zlib';
import { describe, expect, it } from 'vitest';
import { crc32 } from '../../../../protocol/ts/crc32.ts';
import { decodeWeights, fullTurn, ProtocolError } from '../../../../protocol/ts/index.ts';
import { vectorBytes, vectorJson } from './vectors.ts';

interface Meaning {
  bits: number;
  mesh_sha256: string;
  rows: [number, number][][];
  rigid: number[];
  turn?: number[];
}

const good = vectorBytes('weights-12.bin');

async function errorOf(bytes: Uint8Array): Promise<{ code: string; where: string }> {
  try {
    await decodeWeights(bytes);
  } catch (error) {
    if (error instanceof ProtocolError) return { code: error.code, where: error.where };
    throw error;
  }
  throw new Error('was not refused');
}

function withChecksum(bytes: Uint8Array): Uint8Array {
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  view.setUint32(8, 0, true);
  view.setUint32(8, crc32(bytes), true);
  return bytes;
}

function changed(at: number, value: number, size: 1 | 2 | 4): Uint8Array {
  const bytes = good.slice();
  const view = new DataView(bytes.buffer);
  if (size === 1) view.setUint8(at, value);
  if (size === 2) view.setUint16(at, value, true);
  if (size === 4) view.setUint32(at, value, true);
  return withChecksum(bytes);
}

function withPayload(change: (raw: Uint8Array) => Uint8Array): Uint8Array {
  const raw = change(new Uint8Array(inflateSync(good.subarray(64))));
  const packed = deflateSync(raw);
  const bytes = new Uint8Array(64 + packed.length);
  bytes.set(good.subarray(0, 64));
  bytes.set(packed, 64);
  const view = new DataView(bytes.buffer);
  view.setUint32(24, raw.length, true);
  view.setUint32(28, packed.length, true);
  return withChecksum(bytes);
}

describe('decodeWeights', () => {
  it.each([
    ['header', 'truncated', good.subarray(0, 63)],
    ['magic', 'malformed', changed(0, 0, 1)],
    ['version', 'unsupported', changed(4, 4, 2)],
    ['turn', 'truncated', changed(4, 3, 2)],
    ['bits', 'out_of_range', changed(6, 17, 1)],
    ['reserved', 'malformed', changed(7, 1, 1)],
    ['vertex_count', 'missing', changed(12, 0, 4)],
    ['vertex_count', 'too_large', changed(12, 4_000_001, 4)],
    ['set_count', 'out_of_range', changed(16, 11, 4)],
    ['entry_count', 'too_large', changed(20, 48_000_001, 4)],
    ['entry_count', 'mismatch', changed(20, 1, 4)],
    ['raw_bytes', 'malformed', changed(24, 0xffffffff, 4)],
    ['payload', 'malformed', changed(24, 5, 4)],
    ['payload', 'truncated', changed(28, 1000, 4)],
    ['payload', 'malformed', new Uint8Array([...good, 0])],
    ['payload', 'malformed', withPayload((raw) => new Uint8Array([...raw, 0]))],
    ['dictionary', 'malformed', withPayload((raw) => raw.fill(0x80, 0, 1))],
    ['rigid', 'truncated', withPayload((raw) => raw.subarray(0, raw.length - 1))],
    ['rigid', 'out_of_range', withPayload((raw) => raw.fill(9, raw.length - 1))],
    ['rigid', 'out_of_range', withPayload((raw) => raw.fill(9, raw.length - 2, raw.length - 1))],
  ])('Decode_Invalid_IsRefused: %s %s', async (where, code, bytes) => {
    expect(await errorOf(bytes)).toEqual({ where, code });
  });

  it('Decode_EveryPrefix_IsRefused', async () => {
    for (let size = 0; size < good.length; ++size) await errorOf(good.subarray(0, size));
  });

  it('Decode_EveryFlippedBit_IsRefused', async () => {
    for (let bit = 0; bit < good.length * 8; ++bit) {
      const bytes = good.slice();
      bytes[bit >> 3]! ^= 1 << (bit & 7);
      await errorOf(bytes);
    }
  });

  it('Decode_PartsBeyondTheEyes_AreRefusedInVersion1AndBetweenTheKnownInVersion2', async () => {
    const version2 = vectorBytes('../v2/weights-12.bin');
    const changed2 = (at: number, value: number): Uint8Array => {
      const bytes = version2.slice();
      bytes[at] = value;
      return withChecksum(bytes);
    };
    expect(await errorOf(changed2(4, 1))).toEqual({ where: 'rigid', code: 'out_of_range' });
    const raw = (motion: number) => withPayload((bytes) => bytes.fill(motion, bytes.length - 2, bytes.length - 1));
    for (const [motion, version] of [[3, 1], [5, 2], [127, 2]] as const) {
      const bytes = raw(motion);
      bytes[4] = version;
      expect(await errorOf(withChecksum(bytes))).toEqual({ where: 'rigid', code: 'out_of_range' });
    }
    const known = raw(128);
    known[4] = 2;
    expect((await decodeWeights(withChecksum(known))).rigid.at(-1)).toBe(128);
  });

  it.each(['weights-8', 'weights-12', 'weights-16', '../v2/weights-12', '../v3/weights-12'])('Decode_Golden_%s_GivesItsMeaning', async (name) => {
    const meaning = vectorJson(`${name}.json`) as Meaning;
    const { bits } = meaning;
    const table = await decodeWeights(vectorBytes(`${name}.bin`));
    expect(table.bits).toBe(bits);
    expect(table.meshSha256).toBe(meaning.mesh_sha256);
    expect(table.vertexCount).toBe(meaning.rows.length);
    expect(Array.from(table.rigid)).toEqual(meaning.rigid);
    expect(Array.from(table.turn)).toEqual(meaning.turn ?? meaning.rigid.map(() => fullTurn));
    const rows = meaning.rows.map((_, v) =>
      Array.from(table.rowPoints.subarray(table.rowOffsets[v], table.rowOffsets[v + 1]), (point, i) => [
        point,
        table.rowWeights[table.rowOffsets[v]! + i],
      ]),
    );
    const expected = meaning.rows.map((row) => row.map(([p, level]) => [p, Math.fround(level / (2 ** bits - 1))]));
    expect(rows).toEqual(expected);
  });
});

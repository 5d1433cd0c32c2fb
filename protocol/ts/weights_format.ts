import { ByteReader, EndOfBytes, VarintTooLarge } from './byte_io.ts';
import { crc32 } from './crc32.ts';
import { featurePointCount } from './generated/mpeg4.ts';
import { ProtocolError } from './protocol_error.ts';

/** The decoded `weights` artefact in the kernel's layout: the weights of Eq. 7 per vertex of the mesh. */
export interface InfluenceTable {
  vertexCount: number;
  bits: number;
  /** SHA-256, lower-case hexadecimal, of the mesh.drc whose decoded vertex order the table uses. */
  meshSha256: string;
  /** vertexCount + 1 */
  rowOffsets: Uint32Array;
  /** Per entry: dense index of the feature point, increasing within a row. */
  rowPoints: Uint8Array;
  /** Per entry: 0..1 */
  rowWeights: Float32Array;
  /** Per vertex: a value of `rigidMotion`; values from `tongue` on encode the share of the tongue's roll. */
  rigid: Uint8Array;
  /** Per vertex: 255ths of the head's rotation. */
  turn: Uint8Array;
}

const headerBytes = 64;
const maxVertices = 4_000_000;
const maxEntries = 48_000_000;
const maxSets = 2 ** 24;
const maxInflation = 1032; // maximum expansion of deflate

/** The rigid motion of a vertex after Eq. 7 and before the head's rotation. */
export const rigidMotion = {
  none: 0,
  leftEye: 1,
  rightEye: 2,
  leftIris: 3,
  rightIris: 4,
  leftLids: 5,
  rightLids: 6,
  tongue: 128,
} as const;

/** The value of `turn` of a vertex that turns fully with the head. */
export const fullTurn = 255;

/** A vertex's share of the tongue's roll; 0 outside the tongue. */
export const tongueShare = (rigid: number): number => (rigid < rigidMotion.tongue ? 0 : (rigid - 127) / 128);

/** 0 left eye, 1 right eye, -1 neither. */
export const eyeOf = (rigid: number): -1 | 0 | 1 =>
  rigid === rigidMotion.none || rigid > rigidMotion.rightIris ? -1 : rigid % 2 === 1 ? 0 : 1;

/** The eye whose lids a vertex belongs to: 0 left, 1 right, -1 neither. */
export const lidsOf = (rigid: number): -1 | 0 | 1 =>
  rigid === rigidMotion.leftLids ? 0 : rigid === rigidMotion.rightLids ? 1 : -1;

interface WeightsHeader {
  version: number;
  bits: number;
  vertexCount: number;
  setCount: number;
  entryCount: number;
  rawBytes: number;
}

interface InfluenceSet {
  points: Uint8Array;
  unitSum: boolean;
  /** The weights of the last vertex with this set, which predict those of the next. */
  last: Uint32Array;
}

function fail(code: ProtocolError['code'], where: string, message: string): never {
  throw new ProtocolError(code, where, `weights: ${message}`);
}

/** Decodes untrusted bytes: checks all declared sizes against limits before allocation. Throws ProtocolError. */
export async function decodeWeights(bytes: Uint8Array): Promise<InfluenceTable> {
  const header = readHeader(bytes);
  const payload = await inflate(bytes.subarray(headerBytes), header.rawBytes);
  const meshSha256 = Array.from(bytes.subarray(32, 64), (byte) => byte.toString(16).padStart(2, '0')).join('');
  return { vertexCount: header.vertexCount, bits: header.bits, meshSha256, ...readPayload(payload, header) };
}

function readHeader(bytes: Uint8Array): WeightsHeader {
  if (bytes.length < headerBytes) fail('truncated', 'header', 'shorter than its header of 64 bytes');
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (view.getUint32(0, false) !== 0x53425754) fail('malformed', 'magic', 'not SBWT');
  const version = view.getUint16(4, true);
  if (version < 1 || version > 3) fail('unsupported', 'version', `version ${version}, only 1 to 3 are known`);
  const header = {
    version,
    bits: view.getUint8(6),
    vertexCount: view.getUint32(12, true),
    setCount: view.getUint32(16, true),
    entryCount: view.getUint32(20, true),
    rawBytes: view.getUint32(24, true),
  };
  const packedBytes = view.getUint32(28, true);
  if (header.bits < 8 || header.bits > 16) fail('out_of_range', 'bits', 'not 8..16');
  if (view.getUint8(7) !== 0) fail('malformed', 'reserved', 'not zero');
  if (header.vertexCount === 0) fail('missing', 'vertex_count', 'no vertices');
  if (header.vertexCount > maxVertices) fail('too_large', 'vertex_count', `over ${maxVertices}`);
  if (header.entryCount > maxEntries) fail('too_large', 'entry_count', `over ${maxEntries}`);
  if (header.setCount === 0 || header.setCount > Math.min(header.vertexCount, maxSets)) {
    fail('out_of_range', 'set_count', 'not between 1 and the number of vertices');
  }
  if (packedBytes > bytes.length - headerBytes) fail('truncated', 'payload', 'ends before the declared size');
  if (packedBytes < bytes.length - headerBytes) fail('malformed', 'payload', 'bytes after the declared size');
  if (header.rawBytes > maxInflation * packedBytes) {
    fail('malformed', 'raw_bytes', 'more than the packed bytes can hold');
  }
  // The checksum covers the whole file, with its own four bytes set to zero.
  const crc = crc32(bytes.subarray(12), crc32(new Uint8Array(4), crc32(bytes.subarray(0, 8))));
  if (crc !== view.getUint32(8, true)) fail('mismatch', 'crc', 'checksum differs');
  return header;
}

/** Inflates to exactly `size` bytes or throws; never allocates more. */
async function inflate(packed: Uint8Array, size: number): Promise<Uint8Array> {
  const raw = new Uint8Array(size);
  let filled = 0;
  try {
    const stream = new Blob([packed.slice()]).stream().pipeThrough(new DecompressionStream('deflate'));
    const reader = stream.getReader();
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      if (filled + value.length > size) {
        await reader.cancel();
        filled = -1;
        break;
      }
      raw.set(value, filled);
      filled += value.length;
    }
  } catch {
    filled = -1;
  }
  if (filled !== size) fail('malformed', 'payload', 'not a zlib stream of the declared size');
  return raw;
}

type Rows = Pick<InfluenceTable, 'rowOffsets' | 'rowPoints' | 'rowWeights' | 'rigid' | 'turn'>;

function readPayload(payload: Uint8Array, header: WeightsHeader): Rows {
  const from = new ByteReader(payload);
  let field = 'dictionary';
  try {
    const sets = readDictionary(from, header.setCount);
    field = 'set_ids';
    const ids = readSetIds(from, header, sets);
    field = 'weights';
    const rows = readRows(from, header, sets, ids);
    field = 'rigid';
    const rigid = readRigid(from, header);
    field = 'turn';
    const turn = readTurns(from, header);
    if (from.remaining !== 0) fail('malformed', 'payload', 'bytes after the last field');
    return { ...rows, rigid, turn };
  } catch (error) {
    if (error instanceof EndOfBytes || error instanceof VarintTooLarge) fail('truncated', field, 'ends early');
    throw error;
  }
}

function readDictionary(from: ByteReader, count: number): InfluenceSet[] {
  if (count > from.remaining) fail('truncated', 'set_count', 'more sets than bytes');
  const sets: InfluenceSet[] = [];
  for (let i = 0; i < count; ++i) {
    const first = from.u8();
    const unitSum = (first & 0x80) !== 0;
    const points = from.take(first & 0x7f);
    if (unitSum && points.length === 0) fail('malformed', 'dictionary', 'an empty set cannot sum to one');
    points.forEach((point, k) => {
      if (point >= featurePointCount) fail('out_of_range', 'dictionary', `no feature point ${point}`);
      if (k > 0 && point <= points[k - 1]!) fail('malformed', 'dictionary', 'the points of a set are not increasing');
    });
    sets.push({ points, unitSum, last: new Uint32Array(points.length - (unitSum ? 1 : 0)) });
  }
  return sets;
}

function readSetIds(from: ByteReader, header: WeightsHeader, sets: InfluenceSet[]): Uint32Array {
  const planes = header.setCount <= 0x100 ? 1 : header.setCount <= 0x10000 ? 2 : 3;
  const ids = fromPlanes(from.take(header.vertexCount * planes), header.vertexCount);
  let entries = 0;
  ids.forEach((id, v) => {
    const set = sets[id] ?? fail('out_of_range', 'set_ids', `vertex ${v}`);
    entries += set.points.length;
  });
  if (entries !== header.entryCount) fail('mismatch', 'entry_count', `the sets hold ${entries}`);
  return ids;
}

function fromPlanes(planes: Uint8Array, count: number): Uint32Array {
  const values = new Uint32Array(count);
  for (let i = 0; i < planes.length; ++i) {
    const at = i % count;
    values[at] = values[at]! + planes[i]! * 256 ** Math.floor(i / count);
  }
  return values;
}

function readRows(
  from: ByteReader,
  header: WeightsHeader,
  sets: InfluenceSet[],
  ids: Uint32Array,
): Omit<Rows, 'rigid' | 'turn'> {
  let stored = 0;
  for (const id of ids) stored += sets[id]!.last.length;
  const residuals = fromPlanes(from.take(stored * (header.bits <= 8 ? 1 : 2)), stored);

  const total = 2 ** header.bits - 1;
  const rowOffsets = new Uint32Array(header.vertexCount + 1);
  const rowPoints = new Uint8Array(header.entryCount);
  const rowWeights = new Float32Array(header.entryCount);
  let entry = 0;
  let at = 0;
  for (let v = 0; v < ids.length; ++v) {
    const { points, unitSum, last } = sets[ids[v]!]!;
    let sum = 0;
    for (let i = 0; i < points.length; ++i, ++entry) {
      let level = total - sum;
      if (i < last.length) {
        const folded = residuals[at++]!;
        if (folded > total) fail('out_of_range', 'weights', `vertex ${v}`);
        // Undo the folding of signs, then the difference modulo 2^bits.
        const difference = folded % 2 === 1 ? total - (folded >>> 1) : folded >>> 1;
        level = (last[i]! + difference) & total;
        last[i] = level;
      }
      sum += level;
      if (unitSum && sum > total) fail('out_of_range', 'weights', `vertex ${v} sums to more than one`);
      rowPoints[entry] = points[i]!;
      rowWeights[entry] = level / total;
    }
    rowOffsets[v + 1] = entry;
  }
  return { rowOffsets, rowPoints, rowWeights };
}

function readRigid(from: ByteReader, { version, vertexCount }: WeightsHeader): Uint8Array {
  const rigid = new Uint8Array(vertexCount);
  for (let v = 0; v < vertexCount; ) {
    const motion = from.u8();
    const run = from.varint();
    if (!isKnown(motion, version)) fail('out_of_range', 'rigid', 'unknown rigid motion');
    if (run === 0 || run > vertexCount - v) fail('out_of_range', 'rigid', 'invalid length of a run');
    rigid.fill(motion, v, v + run);
    v += run;
  }
  return rigid;
}

/** Only version 3 has them: the differences between consecutive vertices, the first from a full turn. */
function readTurns(from: ByteReader, { version, vertexCount }: WeightsHeader): Uint8Array {
  const turns = new Uint8Array(vertexCount).fill(fullTurn);
  if (version < 3) return turns;
  let last: number = fullTurn;
  from.take(vertexCount).forEach((difference, v) => {
    last = (last + difference) & 0xff;
    turns[v] = last;
  });
  return turns;
}

/** Version 1 has only the motions of the eyes, version 2 also those of irises and tongue. */
function isKnown(motion: number, version: number): boolean {
  if (version === 1) return motion <= rigidMotion.rightEye;
  const lastOfEyes = version === 2 ? rigidMotion.rightIris : rigidMotion.rightLids;
  return motion <= lastOfEyes || motion >= rigidMotion.tongue;
}

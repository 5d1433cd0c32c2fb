import { EndOfBytes, type ByteReader, type ByteWriter } from '../../../../protocol/ts/byte_io.ts';
import { maxBlend, maxExpression, maxViseme, sameExpression, sameViseme, type FaceFrame } from '../../../../protocol/ts/face_frame.ts';
import { limits } from '../../../../protocol/ts/generated/messages.ts';
import { fapGroups, type FapGroup } from '../../../../protocol/ts/generated/mpeg4.ts';
import { ProtocolError } from '../../../../protocol/ts/protocol_error.ts';

/** The binary form of a face state as the differences to another state: SPEC.md, "State". */

const visemeBit = 1 << 0;
const expressionBit = 1 << 1;
const knownBits = (1 << 11) - 1;
const lowLevelGroups = fapGroups.filter((group) => group.number > 1);

function changes(group: FapGroup, from: FaceFrame, state: FaceFrame): number {
  let mask = 0;
  for (let fap = group.first; fap <= group.last; ++fap) {
    if (from.levels[fap] !== state.levels[fap]) mask |= 1 << (fap - group.first);
  }
  return mask;
}

const zigzag = (value: number): number => (value >= 0 ? 2 * value : -2 * value - 1);
const unzigzag = (value: number): number => (value % 2 === 0 ? value / 2 : -(value + 1) / 2);

export function writeState(to: ByteWriter, from: FaceFrame, state: FaceFrame): void {
  checkState(state);
  let bits = 0;
  if (!sameViseme(from.viseme, state.viseme)) bits |= visemeBit;
  if (!sameExpression(from.expression, state.expression)) bits |= expressionBit;
  for (const group of lowLevelGroups) {
    if (changes(group, from, state) !== 0) bits |= 1 << group.number;
  }
  to.varint(bits);
  if (bits & visemeBit) {
    to.u8(state.viseme.select1);
    to.u8(state.viseme.select2);
    to.u8(state.viseme.blend);
  }
  if (bits & expressionBit) {
    to.u8(state.expression.select1);
    to.u8(state.expression.intensity1);
    to.u8(state.expression.select2);
    to.u8(state.expression.intensity2);
  }
  for (const group of lowLevelGroups) {
    if (!(bits & (1 << group.number))) continue;
    const mask = changes(group, from, state);
    to.varint(mask);
    for (let fap = group.first; fap <= group.last; ++fap) {
      if (mask & (1 << (fap - group.first))) to.varint(zigzag(state.levels[fap]! - from.levels[fap]!));
    }
  }
}

/** Decodes the next state in place of `state`, the previous one. `where`: JSON pointer of the state, for errors. */
export function readState(from: ByteReader, state: FaceFrame, where: string): void {
  try {
    readChanges(from, state, where);
  } catch (error) {
    if (error instanceof EndOfBytes) {
      throw new ProtocolError('truncated', where, 'the message ends within a state');
    }
    throw error;
  }
}

function readChanges(from: ByteReader, state: FaceFrame, where: string): void {
  const small = (most: number, name: string): number => {
    const value = from.u8();
    if (value > most) {
      throw new ProtocolError('out_of_range', where + name, `must be between 0 and ${most}, not ${value}`);
    }
    return value;
  };
  const bits = from.varint();
  if (bits > knownBits) throw new ProtocolError('unsupported', where, 'bits of a later version');
  if (bits & visemeBit) {
    state.viseme.select1 = small(maxViseme, '/viseme/select1');
    state.viseme.select2 = small(maxViseme, '/viseme/select2');
    state.viseme.blend = small(maxBlend, '/viseme/blend');
  }
  if (bits & expressionBit) {
    state.expression.select1 = small(maxExpression, '/expression/select1');
    state.expression.intensity1 = small(maxBlend, '/expression/intensity1');
    state.expression.select2 = small(maxExpression, '/expression/select2');
    state.expression.intensity2 = small(maxBlend, '/expression/intensity2');
  }
  for (const group of lowLevelGroups) {
    if (bits & (1 << group.number)) readGroup(from, group, state, where);
  }
}

function readGroup(from: ByteReader, group: FapGroup, state: FaceFrame, where: string): void {
  const mask = from.varint();
  if (mask === 0 || mask >= 2 ** (group.last - group.first + 1)) {
    throw new ProtocolError('out_of_range', `${where}/faps`, 'a mask is zero or has bits outside its group');
  }
  for (let fap = group.first; fap <= group.last; ++fap) {
    if (!(mask & (1 << (fap - group.first)))) continue;
    const level = state.levels[fap]! + unzigzag(from.varint());
    if (Math.abs(level) > limits.max_level) {
      throw new ProtocolError('out_of_range', `${where}/faps/${fap}`, 'beyond 32767 levels');
    }
    state.levels[fap] = level;
  }
}

/** Throws RangeError (a caller's mistake) for a state outside the documented ranges, before it is encoded. */
export function checkState(state: FaceFrame): void {
  const within = (value: number, most: number): boolean => Number.isInteger(value) && value >= 0 && value <= most;
  const { viseme, expression, levels } = state;
  const good =
    within(viseme.select1, maxViseme) &&
    within(viseme.select2, maxViseme) &&
    within(viseme.blend, maxBlend) &&
    within(expression.select1, maxExpression) &&
    within(expression.select2, maxExpression) &&
    within(expression.intensity1, maxBlend) &&
    within(expression.intensity2, maxBlend) &&
    levels.every((level) => level >= -limits.max_level);
  if (!good) throw new RangeError('a face frame outside the documented ranges');
}

import {
  copyFrame,
  lastLowLevelFap,
  maxBlend,
  maxExpression,
  maxViseme,
  neutralFrame,
  sameExpression,
  sameViseme,
  type ExpressionBlend,
  type FaceFrame,
  type VisemeBlend,
} from './face_frame.ts';
import { limits } from './generated/messages.ts';
import { fapGroups, type FapGroup } from './generated/mpeg4.ts';
import { contexts, probabilities, references } from './generated/packed_tables.ts';
import type { BitCoder } from './range_coder.ts';

/** The state that encoder and decoder of a packed stream share: SPEC.md, "Packed form". */
export interface PackedState {
  /** The last four frames, [0] the newest. */
  before: FaceFrame[];
  sequence: number;
  /** Media time of the newest frame, ms. */
  mediaTime: number;
  /** Expected time to the next frame, ms. */
  step: number;
  /** Expected number of frames of the next batch. */
  count: number;
  timeClass: number;
  visemeClass: number;
  expressionClass: number;
  /** Only a keyframe has been coded so far. */
  fresh: boolean;
}

export function packedStart(state: FaceFrame = neutralFrame(), sequence = 0, mediaTime = 0): PackedState {
  const own = copyFrame(state);
  return {
    before: [own, own, own, own], // frames of the history are never modified
    sequence,
    mediaTime,
    step: 40,
    count: 1,
    timeClass: 0,
    visemeClass: 0,
    expressionClass: 0,
    fresh: true,
  };
}

export const copyPacked = (state: PackedState): PackedState => ({ ...state, before: [...state.before] });

const lowLevelGroups = fapGroups.filter((group) => group.number > 1);
const levelBits = 15;
const blendBits = 5;
const line = 0;
const shared = 1;
const hold = 2;

interface Guess {
  level: number;
  cost: number;
  kind: number;
}

const clamp = (value: number, least: number, most: number): number => Math.min(Math.max(value, least), most);
const held = (value: number): number => clamp(value, -limits.max_level, limits.max_level);
/** The number of bits of a number from 0 to 2^31. */
const bitLength = (value: number): number => 32 - Math.clz32(value);
const signClass = (value: number): number => (value === 0 ? 0 : value > 0 ? 1 : 2);

/** Predicts `now` from the reference: scaled by before / referenceBefore, or the reference's step for large ratios. */
function ratio(referenceBefore: number, referenceNow: number, before: number): number {
  if (referenceBefore === 0) return before;
  const product = referenceNow * before;
  const size = Math.abs(referenceBefore);
  const quotient = Math.floor((Math.abs(product) + Math.floor(size / 2)) / size);
  const level = product < 0 === referenceBefore < 0 ? quotient : -quotient;
  const step = referenceNow - referenceBefore;
  return held(Math.abs(level - before) > 2 * Math.abs(step) ? before + step : level);
}

/**
 * The model of the packed form: which bits code frames and times, with which contexts. The same code encodes and
 * decodes: each method takes the value to encode (ignored when decoding) and returns the encoded or decoded value.
 */
export class PackedModel {
  /** JSON pointer of the member whose decoded value is out of range; empty: none. */
  fault = '';
  private readonly coder: BitCoder;
  private readonly state: PackedState;
  /** Prediction error in this frame, by FAP. */
  private readonly off = new Int32Array(lastLowLevelFap + 1);

  constructor(coder: BitCoder, state: PackedState) {
    this.coder = coder;
    this.state = state;
  }

  /** Codes the content of a keyframe except its sequence number and time. `source`: the state to encode. */
  history(source: PackedState): void {
    const { state } = this;
    if (!this.flag(contexts.joinDiffers, !source.fresh)) {
      const now = this.frame(source.before[0]!);
      state.before = [now, now, now, now];
      state.visemeClass = 0;
      state.expressionClass = 0;
      return;
    }
    state.fresh = false;
    this.count(source.count);
    if (this.step(source.step) !== state.step) this.fail('/step');
    state.timeClass = this.coder.bits(2, source.timeClass);
    if (state.timeClass > 2) {
      this.fail('/step');
      state.timeClass = 0;
    }
    for (let i = 3; i >= 0; i -= 1) this.frame(source.before[i]!);
  }

  /** Codes the next frame. Returns it as a new object, which also becomes before[0]. */
  frame(given: FaceFrame): FaceFrame {
    const now = copyFrame(given);
    this.viseme(now.viseme);
    this.expression(now.expression);
    this.off.fill(0);
    for (const group of lowLevelGroups) this.group(group, now);
    this.state.before = [now, ...this.state.before.slice(0, 3)];
    return now;
  }

  /** Codes the number of frames of a batch, 1 to 1024. */
  count(value: number): number {
    let read = this.state.count;
    if (this.flag(contexts.countDiffers, value !== read)) {
      read = this.number(contexts.countLength, 10, value - 1) + 1;
      if (read > limits.max_frames_per_message) this.fail('/frames');
    }
    this.state.count = Math.min(read, limits.max_frames_per_message);
    return read;
  }

  /** Codes the media time of a batch, ms. */
  baseTime(value: number): number {
    const { state } = this;
    const expected = Math.min(state.mediaTime + state.step, Number.MAX_SAFE_INTEGER);
    const read = this.timed(0, expected, value, '/media_time');
    if (read > state.mediaTime && read - state.mediaTime <= limits.max_frame_time) state.step = read - state.mediaTime;
    state.mediaTime = read;
    return read;
  }

  /** Codes the time of the batch's first frame, ms after its media time. */
  offset(value: number): number {
    if (!this.flag(contexts.offsetDiffers, value !== 0)) return 0;
    const read = this.number(contexts.timeLength, 53, value - 1) + 1;
    this.pass(read);
    return read;
  }

  /** Codes the time of a later frame, ms after the frame before. */
  step(value: number): number {
    const read = this.timed(1, this.state.step, value, '/time');
    if (read > 0 && read <= limits.max_frame_time) this.state.step = read;
    this.pass(read);
    return read;
  }

  private pass(time: number): void {
    const { state } = this;
    state.mediaTime += Math.min(time, Number.MAX_SAFE_INTEGER - state.mediaTime);
  }

  private timed(first: number, expected: number, value: number, where: string): number {
    const late = value - expected;
    if (!this.flag(contexts.timeDiffers + 3 * first + this.state.timeClass, late !== 0)) {
      this.state.timeClass = 0;
      return expected;
    }
    const early = this.flag(contexts.timeSign + first, late < 0);
    const size = this.number(contexts.timeLength, 53, Math.abs(late) - 1) + 1;
    this.state.timeClass = early ? 2 : 1;
    if (early ? size > expected : size > Number.MAX_SAFE_INTEGER - expected) {
      this.fail(where);
      return expected;
    }
    return early ? expected - size : expected + size;
  }

  private flag(context: number, value: boolean): boolean {
    return this.coder.bit(probabilities[context]!, value ? 1 : 0) !== 0;
  }

  /** Codes a whole number: the length in bits of value + 1 with `most` contexts, then its bits. */
  private number(lengths: number, most: number, value: number): number {
    const more = value + 1;
    let wanted = 0;
    while (wanted < most && more >= 2 ** (wanted + 1)) wanted += 1;
    let bits = 0;
    while (bits < most && this.flag(lengths + bits, bits < wanted)) bits += 1;
    if (bits === 0) return 0;
    const bitOf = (i: number): boolean => Math.floor(more / 2 ** i) % 2 === 1;
    const context = Math.min(bits, 16);
    let read = 2 + (this.flag(contexts.topBit + context, bitOf(bits - 1)) ? 1 : 0);
    if (bits > 1) read = 2 * read + (this.flag(contexts.secondBit + context, bitOf(bits - 2)) ? 1 : 0);
    if (bits > 2) {
      const rest = 2 ** (bits - 2);
      read = read * rest + this.coder.bits(bits - 2, Math.max(more, 0) % rest);
    }
    return read - 1;
  }

  private signedNumber(sign: number, lengths: number, most: number, value: number): number {
    const negative = this.flag(sign, value < 0);
    const size = this.number(lengths, most, Math.abs(value) - 1) + 1;
    return negative ? -size : size;
  }

  private tree(context: number, bits: number, value: number): number {
    let node = 1;
    for (let i = bits - 1; i >= 0; i -= 1) node = 2 * node + (this.flag(context + node, ((value >> i) & 1) !== 0) ? 1 : 0);
    return node - 2 ** bits;
  }

  private fail(where: string): void {
    this.fault ||= where;
  }

  private bounded(value: number, most: number, where: string): number {
    if (value < 0 || value > most) this.fail(where);
    return clamp(value, 0, most);
  }

  private viseme(now: VisemeBlend): void {
    const { state } = this;
    const was = state.before[0]!.viseme;
    if (!this.flag(contexts.visemeDiffers + state.visemeClass, !sameViseme(now, was))) {
      Object.assign(now, was);
      state.visemeClass = 0;
      return;
    }
    // 0 same selects, 1 swapped, 2 the first stays, 3 the second becomes the first, 4 both are new
    let kind = 4;
    if (now.select1 === was.select1 && now.select2 === was.select2) kind = 0;
    else if (now.select1 === was.select2 && now.select2 === was.select1) kind = 1;
    else if (now.select1 === was.select1) kind = 2;
    else if (now.select1 === was.select2) kind = 3;
    const row = was.blend !== maxBlend ? 2 : was.select2 === 0 ? 0 : 1;
    const question = contexts.visemeKind + 4 * row;
    if (!this.flag(question, kind >= 2)) kind = this.flag(question + 1, kind === 1) ? 1 : 0;
    else if (!this.flag(question + 2, kind > 2)) kind = 2;
    else kind = this.flag(question + 3, kind > 3) ? 4 : 3;

    const select = (value: number, where: string): number =>
      this.bounded(this.tree(contexts.visemeSelect, 4, value), maxViseme, where);
    if (kind === 4) now.select1 = select(now.select1, '/viseme/select1');
    else now.select1 = kind === 1 || kind === 3 ? was.select2 : was.select1;
    if (kind >= 2) {
      const second = this.flag(contexts.visemeSecond + (kind - 2), now.select2 !== 0);
      now.select2 = second ? select(now.select2, '/viseme/select2') : 0;
      if (this.flag(contexts.blendDiffers + (second ? 0 : 1), now.blend !== maxBlend)) {
        const less = this.number(contexts.blendLength, blendBits, maxBlend - now.blend - 1);
        now.blend = this.bounded(maxBlend - 1 - less, maxBlend, '/viseme/blend');
      } else {
        now.blend = maxBlend;
      }
    } else {
      now.select2 = kind === 1 ? was.select1 : was.select2;
      this.share(now, kind === 1);
    }
    state.visemeClass = kind + 1;
  }

  /** Codes the blend of an unchanged pair of visemes, predicted by continuing the share of the previous first one. */
  private share(now: VisemeBlend, swapped: boolean): void {
    const was = this.state.before[0]!.viseme;
    const old = this.state.before[1]!.viseme;
    const from = was.blend;
    let older = from;
    let known = true;
    if (old.select1 === was.select1 && old.select2 === was.select2) older = old.blend;
    else if (old.select1 === was.select2 && old.select2 === was.select1) older = maxBlend - old.blend;
    else if (old.blend === maxBlend && old.select1 === was.select1) older = maxBlend;
    else if (old.blend === maxBlend && old.select1 === was.select2) older = 0;
    else known = false;
    const expected = clamp(2 * from - older, 0, maxBlend);
    const context = known ? 0 : 1;
    let off = (swapped ? maxBlend - now.blend : now.blend) - expected;
    if (this.flag(contexts.shareDiffers + context, off !== 0)) {
      const sign = contexts.shareSign + (from > older ? 2 : 0) + context;
      off = this.signedNumber(sign, contexts.shareLength + blendBits * context, blendBits, off);
    } else {
      off = 0;
    }
    const read = this.bounded(expected + off, maxBlend, '/viseme/blend');
    now.blend = swapped ? maxBlend - read : read;
  }

  private expression(now: ExpressionBlend): void {
    const { state } = this;
    const was = state.before[0]!.expression;
    const differs = this.flag(contexts.expressionDiffers + state.expressionClass, !sameExpression(now, was));
    state.expressionClass = differs ? 1 : 0;
    if (!differs) {
      Object.assign(now, was);
      return;
    }
    const same = now.select1 === was.select1 && now.select2 === was.select2;
    const swapped = now.select1 === was.select2 && now.select2 === was.select1;
    if (!this.flag(contexts.expressionKind, !same)) {
      now.select1 = was.select1;
      now.select2 = was.select2;
    } else if (!this.flag(contexts.expressionKind + 1, !swapped)) {
      now.select1 = was.select2;
      now.select2 = was.select1;
    } else {
      const select = (context: number, value: number, where: string): number =>
        this.bounded(this.tree(context, 3, value), maxExpression, where);
      now.select1 = select(contexts.expressionSelect, now.select1, '/expression/select1');
      now.select2 = select(contexts.expressionSelect + 8, now.select2, '/expression/select2');
    }
    now.intensity1 = this.intensity(now.select1, now.intensity1);
    now.intensity2 = this.intensity(now.select2, now.intensity2);
  }

  /** Codes an expression's intensity, predicted by linear continuation of its earlier values in either slot. */
  private intensity(select: number, now: number): number {
    const of = (blend: ExpressionBlend): number | null =>
      select === 0 ? null
      : blend.select1 === select ? blend.intensity1
      : blend.select2 === select ? blend.intensity2
      : null;
    const was = of(this.state.before[0]!.expression);
    const from = was ?? 0;
    const older = of(this.state.before[1]!.expression) ?? 0;
    const expected = clamp(2 * from - older, 0, maxBlend);
    const row = select === 0 ? 2 : was !== null ? 0 : 1;
    const context = 3 * row + (was === null || from === older ? 0 : from < older ? 1 : 2);
    let off = now - expected;
    if (this.flag(contexts.intensityDiffers + context, off !== 0)) {
      const lengths = contexts.intensityLength + (was !== null ? 0 : blendBits);
      off = this.signedNumber(contexts.intensitySign + context, lengths, blendBits, off);
    } else {
      off = 0;
    }
    return this.bounded(expected + off, maxBlend, '/expression');
  }

  private group(group: FapGroup, now: FaceFrame): void {
    const [a, b, c, d] = this.state.before.map((frame) => frame.levels) as [Int16Array, Int16Array, Int16Array, Int16Array];
    let still = 0;
    let moves = false;
    for (let fap = group.first; fap <= group.last; fap += 1) {
      if (b[fap] !== a[fap] || c[fap] !== a[fap] || d[fap] !== a[fap]) continue;
      const reference = references[fap]!;
      // A reference in another group was coded earlier.
      if (reference !== 0 && reference < group.first && now.levels[reference] !== a[reference]) continue;
      still |= 1 << (fap - group.first);
      moves ||= now.levels[fap] !== a[fap];
    }
    if (still !== 0) {
      const all = still === 2 ** (group.last - group.first + 1) - 1;
      moves = this.flag(contexts.groupMoves + 2 * (group.number - 2) + (all ? 1 : 0), moves);
    }
    for (let fap = group.first; fap <= group.last; fap += 1) {
      if (!moves && ((still >> (fap - group.first)) & 1) !== 0) {
        now.levels[fap] = a[fap]!;
        continue;
      }
      const value = this.level(fap, now, now.levels[fap]!);
      if (Math.abs(value) > limits.max_level) this.fail(`/faps/${fap}`);
      now.levels[fap] = held(value);
    }
  }

  private level(fap: number, now: FaceFrame, value: number): number {
    const { before } = this.state;
    const reference = references[fap]!;
    const best = this.guess(fap, reference, now);
    const referenceStep = reference === 0 ? 0 : now.levels[reference]! - before[0]!.levels[reference]!;
    const referenceOff = reference === 0 ? 0 : signClass(this.off[reference]!);
    const offFlag = referenceOff !== 0 ? 1 : 0;
    const slow = (i: number): boolean => Math.abs(before[i]!.levels[fap]! - before[i + 1]!.levels[fap]!) <= 1;

    let read: number;
    if (best.kind === shared && best.cost === 0) {
      // the FAP has followed its reference exactly
      const reach = Math.min(bitLength(Math.abs(referenceStep)), 7);
      const differs = contexts.followerDiffers + 2 * reach + offFlag;
      const sign = contexts.followerSign + referenceOff;
      read = best.level + this.residual(differs, sign, 10 + Math.min(reach, 4), value - best.level);
    } else if (slow(0) && slow(1) && slow(2) && (best.kind !== shared || referenceStep === 0)) {
      read = this.slowLevel(fap, reference, referenceStep, value);
    } else {
      const reach = Math.min(bitLength(best.cost), 9);
      const row = reference === 0 ? 0 : (best.kind === shared ? 1 : 3) + offFlag;
      const sign = contexts.levelSign + 3 * best.kind + referenceOff;
      read = best.level + this.residual(contexts.levelDiffers + 10 * row + reach, sign, reach, value - best.level);
    }
    this.off[fap] = read - best.level;
    return read;
  }

  /** Codes a FAP that moves by less than a level per frame: the pattern of its steps predicts better than a line. */
  private slowLevel(fap: number, reference: number, referenceStep: number, value: number): number {
    const [a, b, c, d] = this.state.before.map((frame) => frame.levels[fap]!) as [number, number, number, number];
    let pattern = 9 * (a - b) + 3 * (b - c) + (c - d);
    const direction = pattern < 0 ? -1 : 1;
    pattern *= direction;
    const moves = reference === 0 ? 0 : Math.min(Math.abs(referenceStep), 2);
    const context = 2 * pattern + (moves !== 0 ? 1 : 0);
    const step = (value - a) * direction;
    if (!this.flag(contexts.slowDiffers + context, step !== 0)) return a;
    const back = this.flag(contexts.slowSign + context, step < 0);
    let size = 1;
    if (this.flag(contexts.slowMore + 2 * moves + (pattern !== 0 ? 1 : 0), Math.abs(step) > 1)) {
      const set = moves === 2 ? 16 : 15;
      size = this.number(contexts.levelLength + levelBits * set, levelBits, Math.abs(step) - 2) + 2;
    }
    return a + direction * (back ? -size : size);
  }

  private residual(differs: number, sign: number, set: number, value: number): number {
    if (!this.flag(differs, value !== 0)) return 0;
    return this.signedNumber(sign, contexts.levelLength + levelBits * set, levelBits, value);
  }

  private guess(fap: number, reference: number, now: FaceFrame): Guess {
    const { before } = this.state;
    const a = before[0]!.levels[fap]!;
    const b = before[1]!.levels[fap]!;
    const c = before[2]!.levels[fap]!;
    const d = before[3]!.levels[fap]!;
    const lineCost = 2 * Math.abs(a - held(2 * b - c)) + Math.abs(b - held(2 * c - d));
    const holdCost = 2 * Math.abs(a - b) + Math.abs(b - c);
    let best: Guess = { level: held(2 * a - b), cost: lineCost, kind: line };
    if (reference === 0) return lineCost <= holdCost ? best : { level: a, cost: holdCost, kind: hold };

    const r = now.levels[reference]!;
    const ra = before[0]!.levels[reference]!;
    const rb = before[1]!.levels[reference]!;
    const rc = before[2]!.levels[reference]!;
    const shiftCost = 2 * Math.abs(a - held(b + ra - rb)) + Math.abs(b - held(c + rb - rc));
    const ratioCost = 2 * Math.abs(a - ratio(rb, ra, b)) + Math.abs(b - ratio(rc, rb, c));
    const straight = best;
    best = { level: held(a + r - ra), cost: shiftCost, kind: shared };
    if (ratioCost < best.cost) best = { level: ratio(ra, r, a), cost: ratioCost, kind: shared };
    if (lineCost < best.cost) best = straight;
    if (holdCost < best.cost) best = { level: a, cost: holdCost, kind: hold };
    return best;
  }
}

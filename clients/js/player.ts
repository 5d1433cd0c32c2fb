import type { FaceFrame, TimedFrame } from '../../protocol/ts/face_frame.ts';
import type { Frames, Header, Keyframe } from '../../protocol/ts/messages.ts';
import { quantizersOf, standardQuantizers, type QuantizerSteps } from '../../protocol/ts/quantizers.ts';
import { ClockEstimate } from './clock_estimate.ts';
import { Playout, type PlayoutStats } from './playout.ts';
import type { StreamClient } from './stream_client.ts';

/** The part of the kernel that the player uses: poses by number. */
export interface PoseMaker {
  evaluate(frame: FaceFrame, pose: number, steps: QuantizerSteps): void;
  /** Sets the viseme share of Eq. 5 from the stream's header for later calls of `evaluate`; null: the model's own. */
  setVisemeShare?(share: number | null): void;
  interpolate(a: number, b: number, t: number, out: number): void;
  /** Required for `eased` interpolation: the poses before, from, to, after, and the spans between them. */
  ease?(poses: readonly [number, number, number, number], spans: ArrayLike<number>, t: number, out: number): void;
}

export interface PlayerOptions {
  /** The clock, ms; default performance.now(). Must be the clock of the followed client. */
  now?: () => number;
  /**
   * Fixed playout delay behind the stream's clock, ms; default: the smallest that the network allows. Players with the
   * same delay show the same moment.
   */
  delay?: number;
  /**
   * `linear` (default): linear interpolation between frames, as in the paper. `eased`: interpolation on a smooth curve
   * through the same frames that never leaves the range of a pair; needs one more frame ahead and `easedPoseCount`
   * poses.
   */
  interpolation?: 'linear' | 'eased';
  /**
   * An external clock, such as the position of the sound: the media time to show now, ms. NaN means not available; the
   * display's clock is used then. See `updateTo`.
   */
  clock?: () => number;
}

/** The number of the pose that the player writes; it uses poses 1 and 2 (`eased`: 1 to 4) internally. */
export const shownPose = 0;
const fromPose = 1;
const toPose = 2;
const beforePose = 3;
const afterPose = 4;
const easedPoses = [beforePose, fromPose, toPose, afterPose] as const;
export const easedPoseCount = 5;

/** A display step that differs by more than this, ms, from the clock is ignored: the page was blocked or hidden. */
const strangeStep = 50;
/** After a pause without display frames longer than this, ms, the machine may have slept: measure the clock again. */
const longPause = 5000;
const maxHeldFrames = 2048;

/**
 * Plays the frames of a stream at the display's rate, with the delay that `Playout` computes. Interpolates the feature
 * points linearly (and so every vertex, as in the paper) or eased. Adapts its speed by at most 5 %, jumps when it is
 * off by more than half a second, never goes back. With an external clock it shows exactly the clock's media time.
 */
export class Player {
  private readonly poses: PoseMaker;
  private readonly now: () => number;
  private readonly eased: boolean;
  private readonly clock: (() => number) | undefined;
  private readonly playout: Playout;
  private client: StreamClient | null = null;
  private steps: QuantizerSteps = standardQuantizers;
  private visemeShare: number | null = null;
  private lastUpdate = NaN;

  // The frames in use; the first is the last one at or before the playhead.
  private times: number[] = [];
  private states: FaceFrame[] = [];
  /** Media time at which the motion towards each frame begins. */
  private begins: number[] = [];

  // Media times of the frames in the poses `fromPose` and `toPose`.
  private fromTime = NaN;
  private toTime = NaN;
  private shownT = NaN;

  // Eased: the frame before the one in `fromPose`, and the curve chosen for the current pair.
  private beforeTime = NaN;
  private beforeState: FaceFrame | undefined;
  private readonly spans = [0, 0, 0];
  /** Time of the frame at which the last curve ended with zero velocity, because no frame followed yet. */
  private restedAt = NaN;

  constructor(poses: PoseMaker, options: PlayerOptions = {}) {
    this.poses = poses;
    this.now = options.now ?? (() => performance.now());
    this.eased = options.interpolation === 'eased';
    this.clock = options.clock;
    this.playout = new Playout({ ...(options.delay === undefined ? {} : { delay: options.delay }), eased: this.eased });
    if (this.eased && !poses.ease) throw new TypeError('eased interpolation needs PoseMaker.ease');
  }

  /** Displayed media time, ms; NaN before the first frame. */
  get playhead(): number {
    return this.playout.playhead;
  }

  /** ms behind the stream's clock; NaN before the first frame */
  get delay(): number {
    return this.playout.delay;
  }

  /** Statistics of the playout; `clock` is the estimate of the stream's clock. */
  get stats(): Readonly<PlayoutStats> & { readonly clock: ClockEstimate } {
    return { ...this.playout.stats, clock: this.playout.clock };
  }

  /** Plays the frames of a client, with the client's clock estimate. Returns the function that stops this. */
  follow(client: StreamClient): () => void {
    this.client = client;
    this.playout.clock = client.streamClock;
    if (client.header) this.begin(client.header);
    const stops = [
      client.on('header', (header) => this.begin(header)),
      client.on('keyframe', (keyframe) => this.pushKeyframe(keyframe)),
      client.on('frames', (frames) => this.pushFrames(frames)),
    ];
    return () => {
      stops.forEach((stop) => stop());
      this.client = null;
      this.playout.clock = new ClockEstimate();
      this.takeVisemeShare(null); // the share belongs to the stream, not to the face
    };
  }

  /** Handles a header; another epoch is another time line. */
  begin(header: Header): void {
    this.steps = quantizersOf(header);
    if (this.playout.begin(header)) this.clear();
    this.takeVisemeShare(header.viseme_share);
  }

  private takeVisemeShare(share: number | null): void {
    if (share === this.visemeShare) return;
    this.visemeShare = share;
    this.poses.setVisemeShare?.(share);
    this.fromTime = this.toTime = this.shownT = NaN; // the evaluated poses used the old share
  }

  pushKeyframe(keyframe: Keyframe): void {
    this.push([{ time: 0, state: keyframe.state }], keyframe.media_time);
  }

  pushFrames(frames: Frames): void {
    this.push(frames.frames, frames.media_time);
  }

  /** Drops all frames; keeps the displayed pose. */
  clear(): void {
    this.times = [];
    this.states = [];
    this.begins = [];
    this.playout.clear();
    this.fromTime = this.toTime = this.shownT = NaN;
    this.beforeTime = this.restedAt = NaN;
    this.beforeState = undefined;
  }

  /**
   * Advances by one display frame and writes the pose `shownPose`. Allocates nothing. Returns whether the pose changed;
   * if not, a page may skip drawing.
   */
  update(deltaSeconds: number): boolean {
    const now = this.now();
    const passed = now - this.lastUpdate;
    this.lastUpdate = now;
    if (passed > longPause) this.client?.measureClock();
    const mediaTime = this.clock?.() ?? NaN;
    if (Number.isFinite(mediaTime)) return this.updateTo(mediaTime);
    if (this.times.length === 0) return false;
    // The display's frame interval is more regular than the times of its callbacks.
    const step = deltaSeconds * 1000;
    this.playout.advance(now, Math.abs(step - passed) > strangeStep ? passed : step);
    return this.showPlayhead();
  }

  /**
   * Like `update`, with an external clock such as the sound's: shows the face at that media time (ms), limited to the
   * available frames. When the clock goes back by up to half a second, the playhead waits; when it goes back further,
   * the playhead follows it, at most to the oldest frame held.
   */
  updateTo(mediaTime: number): boolean {
    if (this.times.length === 0 || !Number.isFinite(mediaTime)) return false;
    this.playout.moveTo(mediaTime);
    return this.showPlayhead();
  }

  private showPlayhead(): boolean {
    while (this.times.length > 1 && this.times[1]! <= this.playhead) {
      this.beforeTime = this.times.shift()!;
      this.beforeState = this.states.shift()!;
      this.begins.shift();
    }
    return this.show();
  }

  private push(frames: readonly TimedFrame[], mediaTime: number): void {
    const known = this.times.at(-1) ?? -Infinity;
    const before = this.times.length;
    for (const { time, state } of frames) {
      if (mediaTime + time <= (this.times.at(-1) ?? known)) continue; // repeated after a reconnection
      this.begins.push(this.times.at(-1) ?? mediaTime + time);
      this.times.push(mediaTime + time);
      this.states.push(state);
    }
    const count = this.times.length;
    if (count === before) return;
    const first = this.times[before]!;
    this.begins[before] = this.playout.arrived(first, this.times[Math.max(before, count - 2)]!, this.times[count - 1]!, this.now());
    // A hidden page gets no display frames; only the newest frames matter when it is visible again.
    if (count > maxHeldFrames) {
      for (const list of [this.times, this.begins, this.states]) list.splice(0, maxHeldFrames / 2);
    }
  }

  private show(): boolean {
    const from = this.times[0]!;
    const to = this.times.length > 1 ? this.times[1]! : from;
    const another = this.fromTime !== from || this.toTime !== to;
    if (this.fromTime !== from) {
      this.poses.evaluate(this.states[0]!, fromPose, this.steps);
      this.fromTime = from;
      this.shownT = NaN;
    }
    if (this.toTime !== to) {
      this.poses.evaluate(this.states[to === from ? 0 : 1]!, toPose, this.steps);
      this.toTime = to;
      this.shownT = NaN;
    }
    // After a rest the motion takes as long as between two messages instead of the whole length of the rest.
    const span = this.times.length > 1 ? to - this.begins[1]! : 0;
    const t = span > 0 ? Math.max(0, Math.min(1, (this.playhead - (to - span)) / span)) : 0;
    if (this.eased && another) this.chooseCurve(span);
    if (t === this.shownT) return false;
    if (this.eased && span > 0) this.poses.ease!(easedPoses, this.spans, t, shownPose);
    else this.poses.interpolate(fromPose, toPose, t, shownPose);
    this.shownT = t;
    return true;
  }

  /**
   * Chooses the curve of a pair once: a frame that arrives later must not change a curve that is being shown. If no
   * frame follows yet, the curve ends with zero velocity, and the next one begins with zero velocity.
   */
  private chooseCurve(span: number): void {
    const from = this.times[0]!;
    const before = this.restedAt === from || !this.beforeState ? 0 : from - this.beforeTime;
    const after = this.times.length > 2 ? this.times[2]! - this.times[1]! : 0;
    // After a rest the span of the pair is shortened; its neighbours do not belong to the same motion.
    const whole = this.times.length > 1 && span === this.times[1]! - from;
    this.spans[0] = whole ? before : 0;
    this.spans[1] = span;
    this.spans[2] = after;
    if (this.spans[0] > 0) this.poses.evaluate(this.beforeState!, beforePose, this.steps);
    if (after > 0) this.poses.evaluate(this.states[2]!, afterPose, this.steps);
    this.restedAt = after > 0 || this.times.length < 2 ? NaN : this.times[1]!;
  }
}

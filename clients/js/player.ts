import type { FaceFrame, TimedFrame } from '../../protocol/ts/face_frame.ts';
import type { Frames, Header, Keyframe } from '../../protocol/ts/messages.ts';
import { quantizersOf, standardQuantizers, type QuantizerSteps } from '../../protocol/ts/quantizers.ts';
import { ClockEstimate } from './clock_estimate.ts';
import { Playout, type PlayoutStats } from './playout.ts';
import type { StreamClient } from './stream_client.ts';

/** What the player needs of the kernel: poses by number. */
export interface PoseMaker {
  evaluate(frame: FaceFrame, pose: number, steps: QuantizerSteps): void;
  /** Of Eq. 5, for what is evaluated from now on, as a stream's header names it; null: the model's own. */
  setVisemeShare?(share: number | null): void;
  interpolate(a: number, b: number, t: number, out: number): void;
  /** Needed for the interpolation `eased`; poses before, from, to, after with the spans between them. */
  ease?(poses: readonly [number, number, number, number], spans: ArrayLike<number>, t: number, out: number): void;
}

export interface PlayerOptions {
  /** ms; default performance.now(). The same as that of the client that is followed. */
  now?: () => number;
  /**
   * How far behind the stream's clock to play, ms; left out, as little as the network allows. Players with the same delay
   * show the same moment, wherever they are.
   */
  delay?: number;
  /**
   * `linear` (default): each pair of frames by a straight way, as the paper does. `eased`: the same frames at the same
   * times on a curve without corners that never leaves the range of a pair; wants one frame more ahead and
   * `easedPoseCount` poses.
   */
  interpolation?: 'linear' | 'eased';
  /**
   * Media time to show now, ms: where the sound is. NaN while there is none: then the display's clock counts. See
   * `updateTo`.
   */
  clock?: () => number;
}

/** The player writes the pose to show into this number; it uses 1 and 2, when eased 1 to 4, for itself. */
export const shownPose = 0;
const fromPose = 1;
const toPose = 2;
const beforePose = 3;
const afterPose = 4;
const easedPoses = [beforePose, fromPose, toPose, afterPose] as const;
export const easedPoseCount = 5;

/** A display's step that is so far (ms) from what the clock says is not believed: the page was held up, or hidden. */
const strangeStep = 50;
/** Who shows nothing for longer than this (ms) may have slept: the stream's clock is asked for anew. */
const longPause = 5000;
const maxHeldFrames = 2048;

/**
 * Plays the frames of a stream at the display's rate: a little behind the stream's clock (`Playout` says how much), the
 * feature points interpolated linearly, so that every vertex is interpolated as the paper does, or eased. Adapts its
 * speed by at most 5 %, jumps beyond half a second, never goes back. Given a clock, it shows exactly what that says.
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

  // Frames not yet over; the first is the last one at or before the playhead.
  private times: number[] = [];
  private states: FaceFrame[] = [];
  /** When the motion towards each of them begins. */
  private begins: number[] = [];

  // Which frames are in the poses `fromPose` and `toPose`, by media time.
  private fromTime = NaN;
  private toTime = NaN;
  private shownT = NaN;

  // Eased: the frame before the one in `fromPose`, and what the curve of the present pair was decided to be.
  private beforeTime = NaN;
  private beforeState: FaceFrame | undefined;
  private readonly spans = [0, 0, 0];
  /** Time of the frame at which the last curve came to rest, since none followed it yet. */
  private restedAt = NaN;

  constructor(poses: PoseMaker, options: PlayerOptions = {}) {
    this.poses = poses;
    this.now = options.now ?? (() => performance.now());
    this.eased = options.interpolation === 'eased';
    this.clock = options.clock;
    this.playout = new Playout({ ...(options.delay === undefined ? {} : { delay: options.delay }), eased: this.eased });
    if (this.eased && !poses.ease) throw new TypeError('these poses cannot be eased');
  }

  /** Media time that is shown, ms; NaN before the first frame. */
  get playhead(): number {
    return this.playout.playhead;
  }

  /** ms behind the stream's clock; NaN before the first frame */
  get delay(): number {
    return this.playout.delay;
  }

  /** How it goes; `clock` has what is known of the stream's clock. */
  get stats(): Readonly<PlayoutStats> & { readonly clock: ClockEstimate } {
    return { ...this.playout.stats, clock: this.playout.clock };
  }

  /** Plays what a client receives, by the clock that it measures. Returns the function that stops listening. */
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
      this.takeVisemeShare(null); // the stream's, not the face's
    };
  }

  /** A header came: another epoch is another time line. */
  begin(header: Header): void {
    this.steps = quantizersOf(header);
    if (this.playout.begin(header)) this.clear();
    this.takeVisemeShare(header.viseme_share);
  }

  private takeVisemeShare(share: number | null): void {
    if (share === this.visemeShare) return;
    this.visemeShare = share;
    this.poses.setVisemeShare?.(share);
    this.fromTime = this.toTime = this.shownT = NaN; // what was evaluated had another
  }

  pushKeyframe(keyframe: Keyframe): void {
    this.push([{ time: 0, state: keyframe.state }], keyframe.media_time);
  }

  pushFrames(frames: Frames): void {
    this.push(frames.frames, frames.media_time);
  }

  /** Forgets the frames, not the pose that is shown. */
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
   * Moves on by a display frame and writes the pose `shownPose`. Allocates nothing. Returns whether the pose changed:
   * a page may skip drawing when it did not.
   */
  update(deltaSeconds: number): boolean {
    const now = this.now();
    const passed = now - this.lastUpdate;
    this.lastUpdate = now;
    if (passed > longPause) this.client?.measureClock();
    const mediaTime = this.clock?.() ?? NaN;
    if (Number.isFinite(mediaTime)) return this.updateTo(mediaTime);
    if (this.times.length === 0) return false;
    // The display's own step is more even than the moments at which it calls.
    const step = deltaSeconds * 1000;
    this.playout.advance(now, Math.abs(step - passed) > strangeStep ? passed : step);
    return this.showPlayhead();
  }

  /**
   * The same by another's clock, such as the sound's: shows the face of that media time (ms), as far as frames go. A clock
   * that steps back by up to half a second is waited for; one that goes back further is followed, to the oldest frame
   * that is held.
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
      if (mediaTime + time <= (this.times.at(-1) ?? known)) continue; // sent again after a lost connection
      this.begins.push(this.times.at(-1) ?? mediaTime + time);
      this.times.push(mediaTime + time);
      this.states.push(state);
    }
    const count = this.times.length;
    if (count === before) return;
    const first = this.times[before]!;
    this.begins[before] = this.playout.arrived(first, this.times[Math.max(before, count - 2)]!, this.times[count - 1]!, this.now());
    // A hidden page gets no display frames: only the newest frames matter when it is seen again.
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
    // After a rest the face moves as fast as between two messages, not slowly through all of the rest.
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
   * Where the curve comes from and goes to, decided once a pair and kept: a frame that arrives in the middle must not
   * bend what is shown already. Where none follows yet the curve comes to rest, and the next one begins at rest.
   */
  private chooseCurve(span: number): void {
    const from = this.times[0]!;
    const before = this.restedAt === from || !this.beforeState ? 0 : from - this.beforeTime;
    const after = this.times.length > 2 ? this.times[2]! - this.times[1]! : 0;
    // After a silence the pair's own span is shortened: its neighbours are no part of that motion.
    const whole = this.times.length > 1 && span === this.times[1]! - from;
    this.spans[0] = whole ? before : 0;
    this.spans[1] = span;
    this.spans[2] = after;
    if (this.spans[0] > 0) this.poses.evaluate(this.beforeState!, beforePose, this.steps);
    if (after > 0) this.poses.evaluate(this.states[2]!, afterPose, this.steps);
    this.restedAt = after > 0 || this.times.length < 2 ? NaN : this.times[1]!;
  }
}

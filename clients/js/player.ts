import type { FaceFrame } from '../../protocol/ts/face_frame.ts';
import type { Frames, Header, Keyframe } from '../../protocol/ts/messages.ts';
import { quantizersOf, standardQuantizers, type QuantizerSteps } from '../../protocol/ts/quantizers.ts';
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
  /** ms; default performance.now() */
  now?: () => number;
  /** How far behind the newest frame to play, ms; default two send intervals, at least 60. */
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

const maxSpeedChange = 0.05;
/** Further than this from where it should be, the playhead jumps (ms); less far behind, it waits. */
const snapThreshold = 500;
/** Seconds in which a small error is played away. */
const correctionTime = 1;
/** Sooner or later arrivals are compared within this time (ms): drifting clocks and changed routes are forgotten. */
const arrivalWindow = 10_000;
const leastDelay = 60;
const maxHeldFrames = 2048;

/**
 * Plays the frames of a stream at the display's rate: about two send intervals behind the newest, the feature points
 * interpolated linearly, so that every vertex is interpolated as the paper does, or eased. Adapts its speed by at most
 * 5 %, jumps beyond half a second, never goes back. Given a clock, it shows exactly what that says.
 */
export class Player {
  /** Media time that is shown, ms; NaN before the first frame. */
  playhead = NaN;

  private readonly poses: PoseMaker;
  private readonly now: () => number;
  private readonly fixedDelay: number | undefined;
  private readonly eased: boolean;
  private readonly clock: (() => number) | undefined;
  private steps: QuantizerSteps = standardQuantizers;
  private epoch = -1;
  private visemeShare: number | null = null;

  // Frames not yet over; the first is the last one at or before the playhead.
  private times: number[] = [];
  private states: FaceFrame[] = [];
  private announcedInterval = 0;
  private measuredInterval = 0;
  private lastBatchEnd = NaN;

  // Media time minus local time of the arrival that came earliest for its media time: the least delayed one.
  private bestOffset = -Infinity;
  private bestAge = 0;

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
    this.fixedDelay = options.delay;
    this.eased = options.interpolation === 'eased';
    this.clock = options.clock;
    if (this.eased && !poses.ease) throw new TypeError('these poses cannot be eased');
  }

  /** Plays what a client receives. Returns the function that stops listening. */
  follow(client: StreamClient): () => void {
    if (client.header) this.begin(client.header);
    const stops = [
      client.on('header', (header) => this.begin(header)),
      client.on('keyframe', (keyframe) => this.pushKeyframe(keyframe)),
      client.on('frames', (frames) => this.pushFrames(frames)),
    ];
    return () => {
      stops.forEach((stop) => stop());
      this.takeVisemeShare(null); // the stream's, not the face's
    };
  }

  /** A header came: another epoch is another time line. */
  begin(header: Header): void {
    this.steps = quantizersOf(header);
    this.announcedInterval = header.batch_interval > 0 ? header.batch_interval : 0;
    if (this.announcedInterval === 0 && header.fps_hint > 0) this.announcedInterval = 1000 / header.fps_hint;
    if (header.epoch !== this.epoch) this.clear();
    this.epoch = header.epoch;
    this.takeVisemeShare(header.viseme_share);
  }

  private takeVisemeShare(share: number | null): void {
    if (share === this.visemeShare) return;
    this.visemeShare = share;
    this.poses.setVisemeShare?.(share);
    this.fromTime = this.toTime = this.shownT = NaN; // what was evaluated had another
  }

  pushKeyframe(keyframe: Keyframe): void {
    this.push(keyframe.media_time, keyframe.state);
    this.arrived(keyframe.media_time);
  }

  pushFrames(frames: Frames): void {
    for (const { time, state } of frames.frames) this.push(frames.media_time + time, state);
    const end = frames.media_time + frames.frames[frames.frames.length - 1]!.time;
    const interval = end - this.lastBatchEnd;
    if (interval > 0 && interval < 1000) {
      this.measuredInterval = this.measuredInterval === 0 ? interval : this.measuredInterval * 0.9 + interval * 0.1;
    }
    this.lastBatchEnd = end;
    this.arrived(end);
  }

  /** Forgets the frames, not the pose that is shown. */
  clear(): void {
    this.times = [];
    this.states = [];
    this.playhead = NaN;
    this.lastBatchEnd = NaN;
    this.bestOffset = -Infinity;
    this.fromTime = this.toTime = this.shownT = NaN;
    this.beforeTime = this.restedAt = NaN;
    this.beforeState = undefined;
  }

  /** ms behind the newest frame */
  get delay(): number {
    // A curve has to know where it goes after the pair it is in.
    const intervals = this.eased ? 3 : 2;
    return this.fixedDelay ?? Math.max(leastDelay, intervals * (this.announcedInterval || this.measuredInterval));
  }

  /**
   * Moves on by a display frame and writes the pose `shownPose`. Allocates nothing. Returns whether the pose changed:
   * a page may skip drawing when it did not.
   */
  update(deltaSeconds: number): boolean {
    const mediaTime = this.clock?.() ?? NaN;
    if (Number.isFinite(mediaTime)) return this.updateTo(mediaTime);
    if (this.times.length === 0) return false;
    this.advance(deltaSeconds * 1000);
    return this.showPlayhead();
  }

  /**
   * The same by another's clock, such as the sound's: shows the face of that media time (ms), as far as frames go. A clock
   * that steps back by up to half a second is waited for; one that goes back further is followed, to the oldest frame
   * that is held.
   */
  updateTo(mediaTime: number): boolean {
    if (this.times.length === 0 || !Number.isFinite(mediaTime)) return false;
    const back = this.playhead - mediaTime;
    if (!(back > 0 && back <= snapThreshold)) this.playhead = Math.min(mediaTime, this.times.at(-1)!);
    return this.showPlayhead();
  }

  private showPlayhead(): boolean {
    while (this.times.length > 1 && this.times[1]! <= this.playhead) {
      this.beforeTime = this.times.shift()!;
      this.beforeState = this.states.shift()!;
    }
    return this.show();
  }

  private push(time: number, state: FaceFrame): void {
    const last = this.times.at(-1);
    if (last !== undefined && time <= last) return; // known already: sent again after a lost connection
    this.times.push(time);
    this.states.push(state);
    // A hidden page gets no display frames: only the newest frames matter when it is seen again.
    if (this.times.length > maxHeldFrames) {
      this.times.splice(0, maxHeldFrames / 2);
      this.states.splice(0, maxHeldFrames / 2);
    }
  }

  private arrived(mediaTime: number): void {
    const now = this.now();
    const offset = mediaTime - now;
    if (offset >= this.bestOffset || now - this.bestAge > arrivalWindow) {
      this.bestOffset = offset;
      this.bestAge = now;
    }
    if (Number.isNaN(this.playhead)) this.playhead = mediaTime - this.delay;
  }

  private advance(elapsed: number): void {
    const wanted = this.now() + this.bestOffset - this.delay;
    const error = wanted - this.playhead - elapsed;
    let next: number;
    if (Math.abs(error) > snapThreshold) {
      next = wanted;
    } else {
      const change = Math.max(-maxSpeedChange, Math.min(maxSpeedChange, error / (correctionTime * 1000)));
      next = this.playhead + elapsed * (1 + change);
    }
    // Not past the newest frame, and never back.
    this.playhead = Math.max(this.playhead, Math.min(next, this.times.at(-1)!));
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
    // After a silence the face rests and then moves as fast as between two messages, not slowly through the silence.
    const span = Math.min(to - from, Math.max(this.delay, 100));
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

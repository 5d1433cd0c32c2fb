import { frameLayout, momentLayout, playerOptionsLayout, playerStatisticsLayout } from './generated/layouts.ts';
import { freeBlocks, Runtime } from './runtime.ts';
import type { StreamClient } from './stream_client.ts';
import type { StreamClock } from './stream_clock.ts';

/** The part of the kernel that the player uses: poses by number. */
export interface PoseMaker {
  /** `frame`: the address of a semblante_frame in the memory of `runtime`. */
  evaluateAt(runtime: Runtime, frame: number, pose: number): void;
  /** Sets the viseme share of Eq. 5 from the stream's header for later calls of `evaluateAt`; null: the model's own. */
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
  /**
   * Changes a copy of the stream's newest shown frame, a semblante_frame in the memory of `runtime`, and shows it in its place
   * while it returns true: see StreamSpeech.
   */
  overlay?: (runtime: Runtime, frame: number) => boolean;
}

/** Statistics of a playout. Times in ms. */
export interface PlayoutStats {
  /** Current delay behind the stream's clock, and the target that it approaches. */
  delay: number;
  wantedDelay: number;
  /** Interarrival jitter (RFC 3550). */
  jitter: number;
  /** Playhead minus its target by the clock estimate; below 0 while the playhead is held. */
  error: number;
  /** How often frames arrived too late, and the total time without frames. */
  starved: number;
  starvedTime: number;
  snaps: number;
  /** The estimate of the stream's clock; null without a stream. */
  clock: StreamClock | null;
}

/** The number of the pose that the player writes; it uses poses 1 and 2 (`eased`: 1 to 4) internally. */
export const shownPose = 0;
const fromPose = 1;
const toPose = 2;
const beforePose = 3;
const afterPose = 4;
const easedPoses = [beforePose, fromPose, toPose, afterPose] as const;
export const easedPoseCount = 5;

/** The library's side of a player. */
interface PlayerMemory {
  readonly runtime: Runtime;
  readonly player: number;
  readonly moment: number;
  readonly statistics: number;
  /** The frame of the overlay. */
  readonly laid: number;
}

/**
 * Plays the frames of a stream at the display's rate. libsemblante decides which moment to show: with the delay that the
 * network needs, at a speed that varies by at most 5 %, never back. With an external clock it is exactly that clock's
 * media time. Evaluates the two frames of the moment, and interpolates the feature points between them linearly (and so
 * every vertex, as in the paper) or eased.
 */
export class Player {
  /** What evaluates the frames; null: nothing is shown yet. May be set later than the player follows a stream. */
  private poses: PoseMaker | null = null;
  private readonly options: PlayerOptions;
  private readonly now: () => number;
  private readonly eased: boolean;
  private client: StreamClient | null = null;
  private memory: PlayerMemory | null = null;
  private release: (() => void) | null = null;
  private visemeShare: number | null = null;

  // What is in the poses.
  private fromTime = NaN;
  private toTime = NaN;
  private shownT = NaN;
  private isCurve = false;
  private isLaid = false;
  private readonly spans = [0, 0, 0];

  constructor(poses: PoseMaker | null, options: PlayerOptions = {}) {
    this.options = options;
    this.now = options.now ?? (() => performance.now());
    this.eased = options.interpolation === 'eased';
    if (poses) this.show(poses);
  }

  /** From now on shows by these poses. */
  show(poses: PoseMaker): void {
    if (this.eased && !poses.ease) throw new TypeError('eased interpolation needs PoseMaker.ease');
    this.poses = poses;
    this.forgetPoses();
    if (this.visemeShare !== null) poses.setVisemeShare?.(this.visemeShare);
  }

  /** Displayed media time, ms; NaN before the first frame. */
  get playhead(): number {
    return this.memory ? this.memory.runtime.functions.semblante_player_time(this.memory.player) : NaN;
  }

  /** ms behind the stream's clock; NaN before the first frame */
  get delay(): number {
    return this.stats.delay;
  }

  get stats(): Readonly<PlayoutStats> {
    const clock = this.client?.streamClock ?? null;
    if (!this.memory) {
      return { delay: NaN, wantedDelay: NaN, jitter: 0, error: 0, starved: 0, starvedTime: 0, snaps: 0, clock };
    }
    const { runtime, player, statistics } = this.memory;
    runtime.functions.semblante_player_stats(player, statistics);
    const { view } = runtime;
    const of = playerStatisticsLayout;
    return {
      delay: view.getFloat64(statistics + of.delay, true),
      wantedDelay: view.getFloat64(statistics + of.wanted_delay, true),
      jitter: view.getFloat64(statistics + of.jitter, true),
      error: view.getFloat64(statistics + of.error, true),
      starved: runtime.wide(statistics + of.starved),
      starvedTime: view.getFloat64(statistics + of.starved_time, true),
      snaps: runtime.wide(statistics + of.snaps),
      clock,
    };
  }

  /** Plays the frames of a client, with the client's clock estimate. Returns the function that stops this. */
  follow(client: StreamClient): () => void {
    this.client = client;
    client.withStream(({ runtime, stream }) => {
      if (this.client !== client) return;
      if (this.memory?.runtime !== runtime) this.make(runtime);
      runtime.functions.semblante_player_follow(this.memory!.player, stream);
      this.forgetPoses();
    });
    return () => {
      if (this.client !== client) return;
      this.client = null;
      if (this.memory) this.memory.runtime.functions.semblante_player_follow(this.memory.player, 0);
      this.takeVisemeShare(null); // the share belongs to the stream, not to the face
    };
  }

  /** Drops all frames; keeps the displayed pose. */
  clear(): void {
    if (this.memory) this.memory.runtime.functions.semblante_player_clear(this.memory.player);
    this.forgetPoses();
  }

  /** Frees the memory of the library; the player must not be used afterwards. */
  dispose(): void {
    this.release?.();
    this.release = this.memory = this.client = null;
  }

  /**
   * Advances by one display frame and writes the pose `shownPose`. Allocates nothing. Returns whether the pose changed;
   * if not, a page may skip drawing.
   */
  update(deltaSeconds: number): boolean {
    if (this.memory === null) return false;
    const mediaTime = this.options.clock?.() ?? NaN;
    const moved = Number.isFinite(mediaTime) ? this.updateTo(mediaTime) : this.advance(this.memory, deltaSeconds * 1000);
    return this.layOver(this.memory, moved);
  }

  private advance(memory: PlayerMemory, elapsed: number): boolean {
    if (memory.runtime.functions.semblante_player_advance(memory.player, this.now(), elapsed) === 0) return false;
    return this.showMoment(memory);
  }

  private layOver(memory: PlayerMemory, moved: boolean): boolean {
    const { poses } = this;
    const { overlay } = this.options;
    if (!overlay || poses === null) return moved;
    const { runtime, moment, laid } = memory;
    const shown = moment + momentLayout.frames + 2 * frameLayout.bytes;
    runtime.bytes.copyWithin(laid, shown, shown + frameLayout.bytes);
    if (overlay(runtime, laid)) {
      poses.evaluateAt(runtime, laid, shownPose);
      this.isLaid = true;
      return true;
    }
    if (!this.isLaid) return moved;
    this.isLaid = false;
    this.forgetPoses();
    return this.showMoment(memory);
  }

  /**
   * Like `update`, with an external clock such as the sound's: shows the face at that media time (ms), limited to the
   * available frames. When the clock goes back by up to half a second, the playhead waits; when it goes back further,
   * the playhead follows it, at most to the oldest frame held.
   */
  updateTo(mediaTime: number): boolean {
    if (this.memory === null || !Number.isFinite(mediaTime)) return false;
    const { runtime, player } = this.memory;
    if (runtime.functions.semblante_player_move_to(player, mediaTime) === 0) return false;
    return this.showMoment(this.memory);
  }

  private make(runtime: Runtime): void {
    this.release?.();
    const { functions } = runtime;
    const options = (view: DataView, at: number): void => {
      view.setUint32(at + playerOptionsLayout.eased, this.eased ? 1 : 0, true);
      view.setFloat64(at + playerOptionsLayout.delay, this.options.delay ?? 0, true);
    };
    const player = runtime.create(playerOptionsLayout.bytes, options, functions.semblante_player_create);
    const moment = runtime.struct(momentLayout.bytes);
    const statistics = runtime.struct(playerStatisticsLayout.bytes);
    const laid = runtime.alloc(frameLayout.bytes);
    this.memory = { runtime, player, moment, statistics, laid };
    this.release = runtime.owns(this, releasePlayer, this.memory);
  }

  private forgetPoses(): void {
    this.fromTime = this.toTime = this.shownT = NaN;
  }

  private takeVisemeShare(share: number | null): void {
    if (share === this.visemeShare) return;
    this.visemeShare = share;
    this.poses?.setVisemeShare?.(share);
    this.forgetPoses(); // the evaluated poses used the old share
  }

  private showMoment(memory: PlayerMemory): boolean {
    const { runtime, player, moment } = memory;
    const { poses } = this;
    if (poses === null || runtime.functions.semblante_player_moment(player, moment) !== 0) return false;
    const { view } = runtime;
    const of = momentLayout;
    const share = view.getFloat64(moment + of.viseme_share, true);
    this.takeVisemeShare(Number.isNaN(share) ? null : share);
    const from = view.getFloat64(moment + of.from_time, true);
    const to = view.getFloat64(moment + of.to_time, true);
    const t = view.getFloat32(moment + of.t, true);
    if (from !== this.fromTime || to !== this.toTime) {
      if (from !== this.fromTime) evaluate(memory, 1, fromPose, poses);
      evaluate(memory, 2, toPose, poses);
      this.isCurve = view.getUint32(moment + of.is_curve, true) !== 0;
      for (let i = 0; i < 3; i += 1) this.spans[i] = view.getFloat32(moment + of.spans + i * 4, true);
      if (this.isCurve && this.spans[0]! > 0) evaluate(memory, 0, beforePose, poses);
      if (this.isCurve && this.spans[2]! > 0) evaluate(memory, 3, afterPose, poses);
      this.fromTime = from;
      this.toTime = to;
    } else if (t === this.shownT) {
      return false;
    }
    if (this.isCurve) poses.ease!(easedPoses, this.spans, t, shownPose);
    else poses.interpolate(fromPose, toPose, t, shownPose);
    this.shownT = t;
    return true;
  }
}

function releasePlayer({ runtime, player, moment, statistics, laid }: PlayerMemory): void {
  runtime.functions.semblante_player_destroy(player);
  freeBlocks({ runtime, blocks: [moment, statistics, laid] });
}

/** One of the four frames of the moment. */
function evaluate({ runtime, moment }: PlayerMemory, frame: number, pose: number, poses: PoseMaker): void {
  poses.evaluateAt(runtime, moment + momentLayout.frames + frame * frameLayout.bytes, pose);
}

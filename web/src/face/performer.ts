import { standardQuantizers, type QuantizerSteps } from '@protocol/quantizers.ts';
import { Player, shownPose, type FaceFrame, type Kernel, type Pose, type StreamClient } from '@client/index.ts';

/** Time constant of the easing towards a frame set by hand, s: 63 % of the distance. Quick, without a jump. */
const handTimeConstant = 0.055;
/** After it the rest of the way, 0.03 % of it, is done at once. */
const handDuration = 8 * handTimeConstant;
const justBeforeTheEnd = handDuration - 1e-6;

// The player uses the kernel's poses 0 (shown), 1 and 2; the poses below belong to this class.
const handTarget = 3;
const handShown = 4;
const clipFrom = 5;
const clipTo = 6;
export const poseCount = 7;

const isSamePose = (a: Pose, b: Pose): boolean =>
  (Object.keys(a) as (keyof Pose)[]).every((part) => a[part].every((value, i) => value === b[part][i]));

/**
 * Computes the displayed pose in the kernel: from a stream (with the SDK's player), by easing towards a single frame,
 * or from a moment of a clip. Allocates nothing per displayed frame.
 */
export class Performer {
  /** Playout of the stream whose client was given to `listen`. */
  readonly player: Player;
  private stopListening: (() => void) | null = null;
  private shown = handShown;
  private settled = handDuration;
  private enlivened = false;

  /** `clock`: the media time of a stream that is shown, ms, NaN while unknown; without it the player's own. */
  constructor(
    readonly kernel: Kernel,
    clock?: () => number,
  ) {
    this.player = new Player(kernel, clock ? { clock } : {});
  }

  /** The displayed pose. */
  get pose(): Pose {
    return this.kernel.poses[this.shown]!;
  }

  get poseNumber(): number {
    return this.shown;
  }

  /** Connects the player to the frames of a client; null disconnects it. */
  listen(client: StreamClient | null): void {
    this.stopListening?.();
    this.player.clear();
    this.stopListening = client ? this.player.follow(client) : null;
  }

  /** Starts easing from the displayed pose towards `frame`. */
  follow(frame: FaceFrame): void {
    if (this.shown !== handShown) this.kernel.interpolate(this.shown, this.shown, 0, handShown);
    this.kernel.evaluate(frame, handTarget);
    this.shown = handShown;
    // A face that is there already is drawn once, not for the duration of an easing.
    const { poses } = this.kernel;
    this.settled = isSamePose(poses[handShown]!, poses[handTarget]!) ? justBeforeTheEnd : 0;
  }

  /**
   * Replaces the target of the easing by the same frame with idle life added. Once the target is reached, the face
   * follows without easing: easing would cut off a blink before the eye is closed.
   */
  enliven(frame: FaceFrame, steps: QuantizerSteps): void {
    this.kernel.evaluate(frame, handTarget, steps);
    this.enlivened = true;
  }

  /** Shows a moment between two frames of a clip, without easing. */
  showBetween(from: FaceFrame, to: FaceFrame, t: number, steps: QuantizerSteps = standardQuantizers): void {
    this.kernel.evaluate(from, clipFrom, steps);
    if (to !== from) this.kernel.evaluate(to, clipTo, steps);
    this.kernel.interpolate(clipFrom, to === from ? clipFrom : clipTo, t, handShown);
    this.shown = handShown;
    this.settled = handDuration;
  }

  /** Advances by one displayed frame, seconds; `live` follows the stream. Returns whether the pose changed. */
  step(deltaSeconds: number, live: boolean): boolean {
    if (live && this.player.update(deltaSeconds)) {
      this.shown = shownPose;
      return true;
    }
    if (this.shown !== handShown || (this.settled >= handDuration && !this.enlivened)) return false;
    this.enlivened = false;
    this.settled += deltaSeconds;
    const share = this.settled >= handDuration ? 1 : 1 - Math.exp(-deltaSeconds / handTimeConstant);
    this.kernel.interpolate(handShown, handTarget, share, handShown);
    return true;
  }

  /** Frees the memory of player and kernel; the performer must not be used afterwards. */
  dispose(): void {
    this.stopListening?.();
    this.player.dispose();
    this.kernel.dispose();
  }
}

import { standardQuantizers, type QuantizerSteps } from '@protocol/quantizers.ts';
import { Player, shownPose, type FaceFrame, type Kernel, type Pose, type StreamClient } from '@client/index.ts';

/** Seconds in which a pose set by hand closes 63 % of the way: quick, without a jump. */
const handTimeConstant = 0.055;
const handDuration = 12 * handTimeConstant;

// The player keeps poses 0 (shown), 1 and 2 in the kernel; these are ours.
const handTarget = 3;
const handShown = 4;
const clipFrom = 5;
const clipTo = 6;
export const poseCount = 7;

/**
 * Computes the displayed pose in the kernel: of a stream (by the SDK's player), of a single frame, to which it eases, or
 * of a moment of a clip. Allocates nothing per displayed frame.
 */
export class Performer {
  /** Plays out the frames of the stream that is listened to. */
  readonly player: Player;
  private stopListening: (() => void) | null = null;
  private shown = handShown;
  private settled = handDuration;
  private enlivened = false;
  // The frames of a clip whose poses are in the kernel.
  private clipFrames: [FaceFrame | null, FaceFrame | null] = [null, null];

  constructor(readonly kernel: Kernel) {
    this.player = new Player(kernel);
  }

  /** The pose to draw. */
  get pose(): Pose {
    return this.kernel.poses[this.shown]!;
  }

  get poseNumber(): number {
    return this.shown;
  }

  /** Selects the client whose frames the player gets; null: none. */
  listen(client: StreamClient | null): void {
    this.stopListening?.();
    this.player.clear();
    this.stopListening = client ? this.player.follow(client) : null;
  }

  /** Eases from the displayed pose to a frame. */
  follow(frame: FaceFrame): void {
    if (this.shown !== handShown) this.kernel.interpolate(this.shown, this.shown, 0, handShown);
    this.kernel.evaluate(frame, handTarget);
    this.shown = handShown;
    this.settled = 0;
  }

  /**
   * Replaces the frame that is eased to by the same frame with idle life added. Once the face has arrived it follows
   * without easing, which would end a blink before the eye is shut.
   */
  enliven(frame: FaceFrame, steps: QuantizerSteps): void {
    this.kernel.evaluate(frame, handTarget, steps);
    this.enlivened = true;
  }

  /** Shows a moment between two frames of a clip without easing. The frames must not be changed afterwards. */
  showBetween(from: FaceFrame, to: FaceFrame, t: number, steps: QuantizerSteps = standardQuantizers): void {
    if (this.clipFrames[0] !== from) this.kernel.evaluate(from, clipFrom, steps);
    if (this.clipFrames[1] !== to) this.kernel.evaluate(to, clipTo, steps);
    this.clipFrames[0] = from;
    this.clipFrames[1] = to;
    this.kernel.interpolate(clipFrom, clipTo, t, handShown);
    this.shown = handShown;
    this.settled = handDuration;
  }

  /** Advances by the time of one displayed frame; follows the stream when `live`. Returns whether the pose changed. */
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

  dispose(): void {
    this.stopListening?.();
  }
}

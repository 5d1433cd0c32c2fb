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
 * What the face shows: a stream, played out by the SDK's player, a frame set by hand, which it eases to, or a moment of a
 * clip. Nothing is allocated per displayed frame.
 */
export class Performer {
  /** Of what is followed. */
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

  /** What to draw. */
  get pose(): Pose {
    return this.kernel.poses[this.shown]!;
  }

  get poseNumber(): number {
    return this.shown;
  }

  /** Plays what a client receives from now on; null: nothing. */
  listen(client: StreamClient | null): void {
    this.stopListening?.();
    this.player.clear();
    this.stopListening = client ? this.player.follow(client) : null;
  }

  /** Eases from what is shown to a frame set by hand. */
  follow(frame: FaceFrame): void {
    if (this.shown !== handShown) this.kernel.interpolate(this.shown, this.shown, 0, handShown);
    this.kernel.evaluate(frame, handTarget);
    this.shown = handShown;
    this.settled = 0;
  }

  /**
   * The frame set by hand, with what idle life makes of it now. Once the face has eased to that frame it follows at once:
   * easing would round off a blink before the eye is shut.
   */
  enliven(frame: FaceFrame, steps: QuantizerSteps): void {
    this.kernel.evaluate(frame, handTarget, steps);
    this.enlivened = true;
  }

  /** Shows a moment between two frames of a clip, at once. The frames must not change meanwhile. */
  showBetween(from: FaceFrame, to: FaceFrame, t: number, steps: QuantizerSteps = standardQuantizers): void {
    if (this.clipFrames[0] !== from) this.kernel.evaluate(from, clipFrom, steps);
    if (this.clipFrames[1] !== to) this.kernel.evaluate(to, clipTo, steps);
    this.clipFrames[0] = from;
    this.clipFrames[1] = to;
    this.kernel.interpolate(clipFrom, clipTo, t, handShown);
    this.shown = handShown;
    this.settled = handDuration;
  }

  /** Moves on by a displayed frame, along the stream when `live`. Returns whether the pose changed. */
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

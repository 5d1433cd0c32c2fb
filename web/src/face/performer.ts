import type { FaceFrame } from './frame.ts';
import type { LoadedFace } from './loaded_face.ts';
import type { Pose } from './pose.ts';

/** Seconds in which a pose set by hand closes 63 % of the way: quick, without a jump. */
const handTimeConstant = 0.055;

/**
 * What the face shows: follows a frame set by hand with a short ease, or a pose that a stream's player writes. Nothing
 * is allocated after construction.
 */
export class Performer {
  /** What to draw. */
  readonly pose: Pose;
  private readonly target: Pose;
  private settled = 0;

  constructor(private readonly face: LoadedFace) {
    this.pose = face.newPose();
    this.target = face.newPose();
  }

  /** Eases to a frame. */
  follow(frame: FaceFrame): void {
    this.face.evaluate(frame, this.target);
    this.settled = 0;
  }

  /** Shows a frame at once: for streams, whose player has interpolated already. */
  show(frame: FaceFrame): void {
    this.face.evaluate(frame, this.pose);
    this.settled = Infinity;
  }

  /** Advances the ease; returns whether the pose changed. */
  step(deltaSeconds: number): boolean {
    if (this.settled > 12 * handTimeConstant) return false;
    this.settled += deltaSeconds;
    const done = this.settled > 12 * handTimeConstant;
    this.face.interpolate(this.pose, this.target, done ? 1 : 1 - Math.exp(-deltaSeconds / handTimeConstant), this.pose);
    return true;
  }
}

import type { FaceFrame } from './frame.ts';
import type { LoadedFace } from './loaded_face.ts';
import type { Pose } from './pose.ts';

/** Seconds in which a pose set by hand closes 63 % of the way: quick, without a jump. */
const handTimeConstant = 0.055;

/**
 * What the face shows: eases to a frame set by hand, or stands between two frames of a stream. Displacement is linear in
 * the feature points, so a pose between two poses is the paper's interpolation of every vertex. Nothing is allocated
 * after construction.
 */
export class Performer {
  /** What to draw. */
  readonly pose: Pose;
  private readonly target: Pose;
  private readonly before: Pose;
  private readonly after: Pose;
  private beforeFrame: FaceFrame | null = null;
  private afterFrame: FaceFrame | null = null;
  private settled = 0;

  constructor(private readonly face: LoadedFace) {
    this.pose = face.newPose();
    this.target = face.newPose();
    this.before = face.newPose();
    this.after = face.newPose();
  }

  /** Eases to a frame. */
  follow(frame: FaceFrame): void {
    this.face.evaluate(frame, this.target);
    this.settled = 0;
  }

  /** Shows the pose `share` of the way from one frame to another at once. Frames must not change once given. */
  showBetween(from: FaceFrame, to: FaceFrame, share: number): void {
    if (from !== this.beforeFrame) {
      this.face.evaluate(from, this.before);
      this.beforeFrame = from;
    }
    if (to !== this.afterFrame) {
      this.face.evaluate(to, this.after);
      this.afterFrame = to;
    }
    this.face.interpolate(this.before, this.after, share, this.pose);
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

import { Vector3, type PerspectiveCamera } from 'three';

const duration = 0.45; // seconds

/** Animates the camera from one view to another, on an arc around its target instead of through it. */
export class Flight {
  private readonly fromTarget = new Vector3();
  private readonly fromArm = new Vector3();
  private readonly toTarget = new Vector3();
  private readonly toArm = new Vector3();
  private time = 1;

  get flying(): boolean {
    return this.time < 1;
  }

  stop(): void {
    this.time = 1;
  }

  /** `target`: the point that the camera looks at, animated in place; `toArm`: vector from `toTarget` to the camera. */
  start(camera: PerspectiveCamera, target: Vector3, toTarget: Vector3, toArm: Vector3): void {
    this.fromTarget.copy(target);
    this.fromArm.copy(camera.position).sub(target);
    this.toTarget.copy(toTarget);
    this.toArm.copy(toArm);
    this.time = 0;
  }

  arrive(camera: PerspectiveCamera, target: Vector3): void {
    this.time = 1;
    target.copy(this.toTarget);
    camera.position.copy(this.toTarget).add(this.toArm);
  }

  step(camera: PerspectiveCamera, target: Vector3, deltaSeconds: number): void {
    this.time = Math.min(1, this.time + deltaSeconds / duration);
    const ease = 1 - (1 - this.time) ** 3;
    target.lerpVectors(this.fromTarget, this.toTarget, ease);
    const reach = this.fromArm.length() * (1 - ease) + this.toArm.length() * ease;
    camera.position.lerpVectors(this.fromArm, this.toArm, ease);
    // Half way between opposite views the interpolated arm has zero length: use the arm of the destination.
    if (camera.position.lengthSq() < 1e-6 * reach * reach) camera.position.copy(this.toArm);
    camera.position.setLength(reach).add(target);
  }
}

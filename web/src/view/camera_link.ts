import { Vector3 } from 'three';
import type { Stage } from './stage.ts';

/**
 * Keeps two stages seeing their heads from the same side and equally large. The first one leads whenever its camera moves;
 * the second one from the moment it is dragged or zoomed itself until the first moves again. Allocates nothing per frame.
 */
export class CameraLink {
  private readonly target = new Vector3();
  private readonly position = new Vector3();
  private secondLeads = false;

  constructor(
    private readonly first: Stage,
    private readonly second: Stage,
  ) {
    second.controls.addEventListener('start', () => (this.secondLeads = true));
    this.remember();
  }

  /** Lets the first stage lead: the camera of the second was placed by something other than its user. */
  reset(): void {
    this.secondLeads = false;
  }

  /** To call once per frame, after the first stage has moved its camera. */
  step(): void {
    const { first, second } = this;
    const tolerance = first.headRadius * 1e-5;
    if (
      first.camera.position.distanceTo(this.position) > tolerance ||
      first.controls.target.distanceTo(this.target) > tolerance
    )
      this.secondLeads = false;
    if (second.seesOtherThan(first)) {
      if (this.secondLeads) first.copyView(second);
      else second.copyView(first);
    }
    this.remember();
  }

  private remember(): void {
    this.position.copy(this.first.camera.position);
    this.target.copy(this.first.controls.target);
  }
}

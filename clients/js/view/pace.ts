/** What to do so that a device keeps its pace. */
export type Step = 'fewer-pixels' | 'plainer' | 'smaller' | 'larger';

/** Drawn pixels for each pixel of the page, along a side, where even one is too many. */
export const coarse = 0.6;

/** The pixel ratio after `fewer-pixels`. */
export function fewerPixels(ratio: number): number {
  return ratio > 1 ? 1 : coarse;
}

/** Goal: this many pictures a second. */
const goal = 30;
const shortest = 1 / goal;
/** Seconds over which the pace is judged, and after a step until the next. */
const window = 1.5;
const settling = 2;
/** Seconds of good pace before a larger face is tried; each failure doubles it. */
const firstProof = 6;
/** Seconds: one gap of this length comes from a hidden page, several in a row from a slow device. */
const gap = 0.25;

/**
 * Watches the time between drawn pictures while the face moves and decides what to change: fewer pixels, no shadow, a
 * smaller level of detail; and back to a larger level when there is room. One that was too slow is tried again later and
 * later.
 */
export class Pace {
  private time = 0;
  private frames = 0;
  private rest = settling;
  private good = 0;
  private proof = firstProof;
  private risky = false;
  private afterGap = false;
  private readonly cheaper: Step[];

  constructor(cheaper: readonly Step[]) {
    this.cheaper = [...cheaper];
  }

  /** To call for each drawn picture of a moving face; `busySeconds`: the time that this page took for it. */
  tick(deltaSeconds: number, busySeconds: number, hasSmaller: boolean, hasLarger: boolean): Step | null {
    const isFirstGap = deltaSeconds > gap && !this.afterGap;
    this.afterGap = deltaSeconds > gap;
    if (isFirstGap) {
      this.time = this.frames = 0;
      return null;
    }
    this.rest -= deltaSeconds;
    if (this.rest > 0) return null;
    this.time += deltaSeconds;
    this.frames += 1;
    if (this.time < window) return null;
    const mean = this.time / this.frames;
    this.time = this.frames = 0;
    if (mean > shortest * 1.03) return this.slow(hasSmaller);
    this.good = busySeconds < shortest / 2 ? this.good + window : 0;
    if (!hasLarger || this.good < this.proof) return null;
    this.risky = true;
    return this.take('larger');
  }

  private slow(hasSmaller: boolean): Step | null {
    // A larger face that was tried is taken back before anything else.
    if (this.risky && hasSmaller) {
      this.proof *= 2;
      this.risky = false;
      return this.take('smaller');
    }
    const cheaper = this.cheaper.shift();
    if (cheaper) return this.take(cheaper);
    return hasSmaller ? this.take('smaller') : null;
  }

  private take(step: Step): Step {
    this.rest = settling;
    this.good = 0;
    return step;
  }
}

import type { RenderQuality } from '../view/face_renderer.ts';

/** What is known of a device before anything is drawn. */
export interface Device {
  /** by software, on the processor */
  softwareRenderer: boolean;
  cores: number;
  /** GB, as browsers tell it; NaN: unknown */
  memory: number;
  handheld: boolean;
  savesData: boolean;
}

export type QualityName = 'auto' | 'low' | 'medium' | 'high';

const low: RenderQuality = { antialias: false, shadows: false, richSkin: false, roomSize: 64, maxPixelRatio: 1 };
const medium: RenderQuality = { antialias: true, shadows: false, richSkin: true, roomSize: 64, maxPixelRatio: 1.5 };
const high: RenderQuality = { antialias: true, shadows: true, richSkin: true, roomSize: 128, maxPixelRatio: 2 };

/** How to draw, and the largest face. */
export interface Budget {
  render: RenderQuality;
  maxVertices: number;
}

/** Every face begins with a level of at most this size, so that it moves soon; a larger one follows while it plays. */
export const firstVertices = 6000;

export function budgetOf(device: Device, quality: QualityName): Budget {
  const weak = device.softwareRenderer || device.cores <= 2 || device.memory <= 2;
  const name = quality === 'auto' ? (weak ? 'low' : device.handheld ? 'medium' : 'high') : quality;
  // A phone has a fast graphics processor: its shadow is left out, not its vertices.
  const maxVertices = device.savesData ? firstVertices : { low: firstVertices, medium: 20_000, high: 60_000 }[name];
  return { render: { low, medium, high }[name], maxVertices };
}

/** What this browser tells of its device. `renderer`: name of the graphics processor, or empty. */
export function thisDevice(renderer: string): Device {
  const facts = navigator as Navigator & { deviceMemory?: number; connection?: { saveData?: boolean } };
  return {
    softwareRenderer: /swiftshader|llvmpipe|software|basic render/i.test(renderer),
    cores: navigator.hardwareConcurrency || 4,
    memory: facts.deviceMemory ?? NaN,
    handheld: matchMedia('(pointer: coarse)').matches,
    savesData: facts.connection?.saveData ?? false,
  };
}

/** What to do so that a device keeps its pace. */
export type Step = 'fewer-pixels' | 'plainer' | 'smaller' | 'larger';

/** Drawn pixels for each pixel of the page where even one is too many. */
const coarse = 0.6;

/** The pixel ratio after `fewer-pixels`. */
export function fewerPixels(ratio: number): number {
  return ratio > 1 ? 1 : coarse;
}

/** What a device can be spared without changing the face, in this order. */
export function cheaperSteps(render: RenderQuality, devicePixelRatio: number): Step[] {
  const steps: Step[] = [];
  if (Math.min(render.maxPixelRatio, devicePixelRatio) > 1) steps.push('fewer-pixels');
  if (render.shadows || render.richSkin) steps.push('plainer');
  steps.push('fewer-pixels');
  return steps;
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

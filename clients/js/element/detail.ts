import type { RenderQuality } from '../view/face_renderer.ts';
import type { Step } from '../view/pace.ts';

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

/** What a device can be spared without changing the face, in this order. */
export function cheaperSteps(render: RenderQuality, devicePixelRatio: number): Step[] {
  const steps: Step[] = [];
  if (Math.min(render.maxPixelRatio, devicePixelRatio) > 1) steps.push('fewer-pixels');
  if (render.shadows || render.richSkin) steps.push('plainer');
  steps.push('fewer-pixels');
  return steps;
}

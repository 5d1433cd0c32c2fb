import { idleAt, type IdleMotion } from '@client/idle.ts';
import { neutralFrame, type FaceFrame } from '@client/index.ts';
import type { IdleLife } from '@protocol/performance_document.ts';
import { quantize } from '@protocol/quantizers.ts';
import { fineSteps, refineLevels } from './fine_steps.ts';
import { shutLids } from './frame.ts';

const unitsPerDegree = 1e5 * (Math.PI / 180); // AU: 1e-5 rad

/** The rotation FAPs, each with the component of the idle motion that drives it. */
const turns: readonly (readonly [number, Exclude<keyof IdleMotion, 'lidClosure'>])[] = [
  [23, 'eyeYaw'],
  [24, 'eyeYaw'],
  [25, 'eyePitch'],
  [26, 'eyePitch'],
  [48, 'headPitch'],
  [49, 'headYaw'],
  [50, 'headRoll'],
];

/** Adds idle life (blinks, glances, small head motions) to the frame set with the sliders. */
export class IdlePlayer {
  /** Quantizer steps of the frames that `step` returns. */
  readonly steps = fineSteps;
  private readonly frame = neutralFrame();
  private elapsed = 0;

  constructor(
    private readonly held: FaceFrame,
    private readonly settings: IdleLife,
  ) {}

  /** Advances and returns the frame to show: the same object at each call. */
  step(deltaSeconds: number): FaceFrame {
    this.elapsed += deltaSeconds * 1000;
    const { frame, held, steps } = this;
    const motion = idleAt(this.settings, this.elapsed);
    frame.viseme = held.viseme;
    frame.expression = held.expression;
    refineLevels(held.levels, frame.levels);
    for (const [fap, part] of turns) frame.levels[fap]! += quantize(unitsPerDegree * motion[part], steps[fap]!) ?? 0;
    for (const [fap, shut] of shutLids) {
      const open = frame.levels[fap]! * steps[fap]!;
      frame.levels[fap] = quantize(open + motion.lidClosure * (shut - open), steps[fap]!) ?? 0;
    }
    return frame;
  }
}

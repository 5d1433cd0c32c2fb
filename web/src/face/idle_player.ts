import { neutralFrame, type FaceFrame } from '@client/index.ts';
import { Performance, restingFace, type Library } from '@client/motion/index.ts';
import { quantize } from '@protocol/quantizers.ts';
import { fineSteps, refineLevels } from './fine_steps.ts';
import { shutLids } from './frame.ts';
import { performanceHeader } from './performance_header.ts';

export interface IdleLife {
  seed: number;
  blinksPerMinute: number;
  /** Size of the motions of the head and of the eyes, 0..1. */
  head: number;
  eyes: number;
}

/** The rotation FAPs: eyes and head. */
const turns = [23, 24, 25, 26, 48, 49, 50] as const;

/** Adds idle life (blinks, glances, small head motions) to the frame set with the sliders. */
export class IdlePlayer {
  /** Quantizer steps of the frames that `step` returns. */
  readonly steps = fineSteps;
  private readonly frame = neutralFrame();
  private readonly face = restingFace();
  private readonly idle: Performance;
  private elapsed = 0;

  constructor(
    library: Library,
    private readonly held: FaceFrame,
    { seed, blinksPerMinute, head, eyes }: IdleLife,
  ) {
    const idle = { seed, blinks_per_minute: blinksPerMinute, head, eyes };
    this.idle = new Performance(library, JSON.stringify({ ...performanceHeader, idle }));
  }

  /** Advances and returns the frame to show: the same object at each call. */
  step(deltaSeconds: number): FaceFrame {
    this.elapsed += deltaSeconds * 1000;
    const { frame, held, steps } = this;
    const { faps } = this.idle.at(this.elapsed, this.elapsed, this.face);
    frame.viseme = held.viseme;
    frame.expression = held.expression;
    refineLevels(held.levels, frame.levels);
    // By index: iterators are allocated, and this runs for each drawn frame.
    for (let i = 0; i < turns.length; i += 1) {
      const fap = turns[i]!;
      frame.levels[fap]! += quantize(faps[fap]!, steps[fap]!) ?? 0;
    }
    for (let i = 0; i < shutLids.length; i += 1) {
      const fap = shutLids[i]![0];
      const shut = shutLids[i]![1];
      const open = frame.levels[fap]! * steps[fap]!;
      frame.levels[fap] = quantize(open + (faps[fap]! / shut) * (shut - open), steps[fap]!) ?? 0;
    }
    return frame;
  }
}

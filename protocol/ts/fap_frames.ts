import { copyFrame, neutralFrame, type TimedFrame } from './face_frame.ts';
import type { FapFile } from './fap_file.ts';
import { limits } from './generated/messages.ts';
import { ProtocolError } from './protocol_error.ts';
import { quantize, standardQuantizers, type QuantizerSteps } from './quantizers.ts';

export interface FapMeaning {
  /** Value of a FAP that a frame omits. Default: zero, as in the players of such files. */
  absent?: 'zero' | 'keep';
  /** Motion in gaps of the frame numbers. Default: hold, because writers omit repeated frames. */
  gaps?: 'hold' | 'interpolate';
  /** Quantizer steps of the frames' stream. */
  steps?: QuantizerSteps;
}

/**
 * Converts a .fap file to frames of a stream, with times in ms from its start. With `hold`, a copy of the frame before
 * a gap ends the gap. Levels are clamped to the range of a message. Throws ProtocolError beyond 24 hours.
 */
export function framesOfFap(file: FapFile, meaning: FapMeaning = {}): TimedFrame[] {
  const steps = meaning.steps ?? standardQuantizers;
  const timeOf = (number: number): number => Math.round((number * 1000) / file.rate);
  if ((file.frames.at(-1)!.number * 1000) / file.rate > limits.max_frame_time) {
    throw new ProtocolError('out_of_range', '', 'the file lasts longer than 24 hours');
  }
  const frames: TimedFrame[] = [];
  let state = neutralFrame();
  let before = 0;
  for (const { number, present, viseme, expression, values } of file.frames) {
    if (meaning.gaps !== 'interpolate' && number > before + 1) frames.push({ time: timeOf(number - 1), state });
    state = meaning.absent === 'keep' ? copyFrame(state) : neutralFrame();
    if (viseme) state.viseme = { select1: viseme.select1, select2: viseme.select2, blend: viseme.blend };
    if (expression) {
      const { select1, intensity1, select2, intensity2 } = expression;
      state.expression = { select1, intensity1, select2, intensity2 };
    }
    for (const fap of present) {
      if (fap < 3) continue;
      const value = values[fap]!;
      state.levels[fap] = quantize(value, steps[fap]!) ?? Math.sign(value) * limits.max_level;
    }
    frames.push({ time: timeOf(number), state });
    before = number;
  }
  return frames;
}

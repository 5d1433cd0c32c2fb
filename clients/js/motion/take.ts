import { neutralFrame, type TimedFrame } from '../../../protocol/ts/face_frame.ts';
import { standardQuantizers, type QuantizerSteps } from '../../../protocol/ts/quantizers.ts';
import { readFrame, writeFrame } from '../frames.ts';
import { takeOptionsLayout, takeWarningLayout, timedFrameLayout } from '../generated/layouts.ts';
import { bufferTooSmall, refusedBytes, withBytes } from '../bytes.ts';
import type { Library } from './library.ts';

/** `fap`: protocol/FAP_FILE.md. `live_link_csv`: the CSV of the app Live Link Face. */
export type TakeFormat = 'fap' | 'live_link_csv';
const formats: readonly TakeFormat[] = ['fap', 'live_link_csv'];

export interface TakeOptions {
  /** The value of a FAP that a frame of a .fap file omits. Default: zero, as in the players of such files. */
  absent?: 'zero' | 'keep';
  /** Motion where a .fap file leaves out frame numbers. Default: hold, because writers omit repeated frames. */
  gaps?: 'hold' | 'interpolate';
  /** FAP units per level of the frames; levels beyond the range of a message are limited to it. */
  steps?: QuantizerSteps;
}

/** A deviation from the format that was accepted. */
export interface TakeWarning {
  /** Of a .fap file: the index in the list of FAP_FILE.md. */
  oddity: number;
  /** The first line with it, from 1; 0: unknown. */
  line: number;
  /** Number of such lines or values; 0: unknown. */
  count: number;
  /** In words, with the line. */
  message: string;
}

/** A file of recorded motion. */
export interface Take {
  /** Frames per second, of the file if it says so, else by the mean distance of the frames. */
  frameRate: number;
  /** By rising time from the start, ms. */
  frames: TimedFrame[];
  warnings: TakeWarning[];
}

/** Reads a file of recorded motion. Throws ProtocolError; its `where` is "line 12" or "line 12, word 3". */
export function readTake(library: Library, format: TakeFormat, text: string | Uint8Array, options: TakeOptions = {}): Take {
  const { functions } = library;
  const asked = library.struct(takeOptionsLayout.bytes);
  library.view.setUint32(asked + takeOptionsLayout.absent, options.absent === 'keep' ? 1 : 0, true);
  library.view.setUint32(asked + takeOptionsLayout.gaps, options.gaps === 'interpolate' ? 1 : 0, true);
  try {
    const take = withBytes(library, text, (at, size) =>
      library.made(
        (handle, error) => functions.semblante_take_read(formats.indexOf(format), at, size, asked, handle, error),
        refusedBytes,
      ),
    );
    try {
      return {
        frameRate: functions.semblante_take_frame_rate(take),
        frames: framesOf(library, take, options.steps ?? standardQuantizers),
        warnings: warningsOf(library, take),
      };
    } finally {
      functions.semblante_take_destroy(take);
    }
  } finally {
    library.free(asked);
  }
}

function framesOf(library: Library, take: number, steps: QuantizerSteps): TimedFrame[] {
  const counter = library.alloc(4);
  try {
    const first = library.functions.semblante_take_frames(take, counter);
    const { view } = library;
    return Array.from({ length: view.getUint32(counter, true) }, (_, i) => {
      const at = first + i * timedFrameLayout.bytes;
      const time = view.getFloat64(at + timedFrameLayout.time, true);
      return { time, state: readFrame(view, at + timedFrameLayout.frame, neutralFrame(), steps) };
    });
  } finally {
    library.free(counter);
  }
}

function warningsOf(library: Library, take: number): TakeWarning[] {
  const { functions } = library;
  const of = takeWarningLayout;
  const at = library.struct(of.bytes);
  try {
    return Array.from({ length: functions.semblante_take_warning_count(take) }, (_, i) => {
      functions.semblante_take_get_warning(take, i, at);
      const [oddity, line, count] = [of.oddity, of.line, of.count].map((member) => library.view.getUint32(at + member, true));
      return { oddity: oddity!, line: line!, count: count!, message: library.text(at + of.message) };
    });
  } finally {
    library.free(at);
  }
}

/**
 * Writes frames by rising time as a file. `rate`: frames per second of the file; 0: by the times. Throws ProtocolError for
 * frames that the format cannot hold.
 */
export function writeTake(
  library: Library,
  format: TakeFormat,
  frames: readonly TimedFrame[],
  rate = 0,
  steps: QuantizerSteps = standardQuantizers,
): Uint8Array {
  const { bytes } = timedFrameLayout;
  const block = library.alloc(Math.max(1, frames.length) * bytes);
  const length = library.alloc(4);
  let text = 0;
  const write = (error: number): number =>
    library.functions.semblante_take_write(formats.indexOf(format), block, frames.length, rate, text, length, error);
  try {
    frames.forEach(({ time, state }, i) => {
      library.view.setFloat64(block + i * bytes + timedFrameLayout.time, time, true);
      writeFrame(library.view, block + i * bytes + timedFrameLayout.frame, state, steps);
    });
    library.attempt((error) => {
      const result = write(error);
      return result === bufferTooSmall ? 0 : result;
    }, refusedBytes);
    const needed = library.view.getUint32(length, true);
    text = library.alloc(Math.max(1, needed));
    library.attempt(write, refusedBytes);
    return library.bytes.slice(text, text + needed);
  } finally {
    for (const at of [block, length, text]) library.free(at);
  }
}

import { lastLowLevelFap, neutralFrame, type FaceFrame } from '../../../protocol/ts/face_frame.ts';
import { standardQuantizers, type QuantizerSteps } from '../../../protocol/ts/quantizers.ts';
import { fapOf, readFrame, readSelects } from '../frames.ts';
import { frameLayout } from '../generated/layouts.ts';
import { refusedBytes, withBytes } from '../bytes.ts';
import type { Library } from './library.ts';

/** The face at one moment, in FAP units. */
export interface PerformedFace {
  viseme: FaceFrame['viseme'];
  expression: FaceFrame['expression'];
  /** by FAP number */
  faps: Float64Array;
}

/** What `Performance.at` writes into. */
export function restingFace(): PerformedFace {
  const { viseme, expression } = neutralFrame();
  return { viseme, expression, faps: new Float64Array(lastLowLevelFap + 1) };
}

/**
 * A performance document (protocol/SPEC.md, section 9) played locally: the face as a function of time, the same as on a
 * server. Any time may be requested; increasing times are fastest.
 */
export class Performance {
  /** For display. */
  readonly name: string;
  /** ms; 0: endless. */
  readonly duration: number;
  private readonly handle: number;
  private readonly frame: number;
  private readonly release: () => void;

  /** Throws ProtocolError; its `where` is the JSON pointer. */
  constructor(private readonly library: Library, document: string | Uint8Array) {
    const { functions } = library;
    const handle = (this.handle = withBytes(library, document, (at, size) =>
      library.made((made, error) => functions.semblante_performance_create(at, size, made, error), refusedBytes),
    ));
    const frame = (this.frame = library.alloc(frameLayout.bytes));
    this.release = library.owns(this, releasePerformance, { library, handle, frame });
    this.name = library.text(functions.semblante_performance_name(handle));
    this.duration = functions.semblante_performance_duration(handle);
  }

  /**
   * The face at `ms` after the start; `idleMs` is the time of idle life, which a loop of the cues does not restart. Throws
   * RangeError for a time below 0 or over 9e15. Allocates nothing when it is given what to write `into`.
   */
  at(ms: number, idleMs = ms, into: PerformedFace = restingFace()): PerformedFace {
    this.evaluate(ms, idleMs);
    const { view } = this.library;
    readSelects(view, this.frame, into);
    for (let fap = 3; fap <= lastLowLevelFap; ++fap) into.faps[fap] = fapOf(view, this.frame, fap);
    return into;
  }

  /** The face as the frame that a stream would send; `into` as in `at`. */
  frameAt(ms: number, idleMs = ms, steps: QuantizerSteps = standardQuantizers, into: FaceFrame = neutralFrame()): FaceFrame {
    this.evaluate(ms, idleMs);
    return readFrame(this.library.view, this.frame, into, steps);
  }

  /** Frees the memory of the library; the performance must not be used afterwards. */
  dispose(): void {
    this.release();
  }

  private evaluate(ms: number, idleMs: number): void {
    if (this.library.functions.semblante_performance_frame_at(this.handle, ms, idleMs, this.frame) !== 0)
      throw new RangeError(`a performance has no face at ${ms} ms, idle life at ${idleMs} ms`);
  }
}

function releasePerformance({ library, handle, frame }: { library: Library; handle: number; frame: number }): void {
  library.functions.semblante_performance_destroy(handle);
  library.free(frame);
}

import { neutralFrame, type FaceFrame } from '../../../protocol/ts/face_frame.ts';
import { standardQuantizers, type QuantizerSteps } from '../../../protocol/ts/quantizers.ts';
import { readFrame, writeFrame } from '../frames.ts';
import { frameLayout } from '../generated/layouts.ts';
import { freeBlocks } from '../runtime.ts';
import { type Library } from './library.ts';

/** All values in order, or some by name (the others are 0). */
export type Coefficients = ArrayLike<number> | Readonly<Record<string, number>>;

export interface Bridged {
  frame: FaceFrame;
  /** Number of values outside 0..1, which were clamped. */
  clamped: number;
}

/** A system's values as the library knows them: names in order, and conversions by address. */
interface System {
  kind: string;
  names: readonly string[];
  toFrame(values: number, frame: number, error: number): number;
  ofFrame(frame: number, values: number): number;
}

/**
 * Faces of other systems: ARKit's 52 blend shapes, as Live Link Face sends them, and the 15 visemes of Oculus Lipsync. The
 * rules are in core/bridges/README.md. NaN, infinity, an unknown name or a wrong number of values throws RangeError.
 */
export class Bridges {
  /** In the order of Live Link Face's stream. */
  readonly arkitNames: readonly string[];
  /** In the order of Oculus Lipsync, which is that of FAP 1. */
  readonly oculusNames: readonly string[];
  private readonly arkit: System;
  private readonly oculus: System;
  private readonly frame: number;
  private readonly values: number;
  private readonly release: () => void;

  constructor(private readonly library: Library) {
    const { functions } = library;
    this.arkitNames = namesBy(library, functions.semblante_arkit_name);
    this.oculusNames = namesBy(library, functions.semblante_oculus_name);
    this.arkit = {
      kind: "ARKit's shapes",
      names: this.arkitNames,
      toFrame: functions.semblante_frame_from_arkit,
      ofFrame: functions.semblante_arkit_from_frame,
    };
    this.oculus = {
      kind: 'the visemes of Oculus Lipsync',
      names: this.oculusNames,
      toFrame: functions.semblante_frame_from_oculus,
      ofFrame: functions.semblante_oculus_from_frame,
    };
    const frame = (this.frame = library.alloc(frameLayout.bytes));
    const values = (this.values = library.alloc(4 * this.arkitNames.length));
    this.release = library.owns(this, freeBlocks, { runtime: library, blocks: [frame, values] });
  }

  /** A frame of ARKit's coefficients; names also as Live Link Face writes them ("JawOpen"). */
  fromArkit(coefficients: Coefficients, steps: QuantizerSteps = standardQuantizers): Bridged {
    return this.from(this.arkit, coefficients, steps);
  }

  /** ARKit's coefficients of a frame, each in 0..1. */
  toArkit(frame: FaceFrame, steps: QuantizerSteps = standardQuantizers): Float32Array {
    return this.to(this.arkit, frame, steps);
  }

  /** A frame whose FAP 1 comes nearest to the weights. */
  fromOculus(weights: Coefficients, steps: QuantizerSteps = standardQuantizers): Bridged {
    return this.from(this.oculus, weights, steps);
  }

  /** The weights of sum 1 that fit the mouth of a frame best: FAP 1's, changed by the low-level FAPs. */
  toOculus(frame: FaceFrame, steps: QuantizerSteps = standardQuantizers): Float32Array {
    return this.to(this.oculus, frame, steps);
  }

  /** Frees the memory of the library; the object must not be used afterwards. */
  dispose(): void {
    this.release();
  }

  private from(system: System, given: Coefficients, steps: QuantizerSteps): Bridged {
    const { library } = this;
    const values = inOrder(system, given);
    values.forEach((value, i) => library.view.setFloat32(this.values + 4 * i, value, true));
    library.attempt(
      (error) => system.toFrame(this.values, this.frame, error),
      (_, where, message) => new RangeError(`${where} ${message}`),
    );
    const frame = readFrame(library.view, this.frame, neutralFrame(), steps);
    return { frame, clamped: values.filter((value) => value < 0 || value > 1).length };
  }

  private to(system: System, frame: FaceFrame, steps: QuantizerSteps): Float32Array {
    const { library } = this;
    writeFrame(library.view, this.frame, frame, steps);
    if (system.ofFrame(this.frame, this.values) !== 0) throw new RangeError('a FAP of the frame is not a finite number');
    return Float32Array.from(system.names, (_, i) => library.view.getFloat32(this.values + 4 * i, true));
  }
}

function namesBy(library: Library, nameOf: (index: number) => number): string[] {
  const names: string[] = [];
  for (let at = nameOf(0); at !== 0; at = nameOf(names.length)) names.push(library.text(at));
  return names;
}

function inOrder({ kind, names }: System, given: Coefficients): number[] {
  if ('length' in given && typeof given.length === 'number') {
    if (given.length !== names.length) throw new RangeError(`${kind} are ${names.length} numbers, not ${given.length}`);
    return Array.from(given as ArrayLike<number>);
  }
  const values = names.map(() => 0);
  for (const [name, value] of Object.entries(given as Readonly<Record<string, number>>)) {
    const index = names.findIndex((known) => known.toLowerCase() === name.toLowerCase());
    if (index < 0) throw new RangeError(`${name} is not one of ${kind}`);
    values[index] = value;
  }
  return values;
}

import { heardLayout, listenerOptionsLayout } from '../generated/layouts.ts';

/** The functions of `semblante_listen.wasm`: clients/runtime/semblante.h. */
interface ListenFunctions {
  memory: WebAssembly.Memory;
  malloc(bytes: number): number;
  free(at: number): void;
  _initialize(): void;
  semblante_listener_create(options: number, listener: number, error: number): number;
  semblante_listener_destroy(listener: number): void;
  semblante_listener_push(listener: number, samples: number, count: number, taken: number, heard: number): number;
}

/** What is heard in 10 ms. */
export interface Heard {
  /** The middle of the 10 ms: ms after the first sample. */
  time: number;
  /** dB of full scale. */
  level: number;
  /** Of the visemes of FAP 1 and of Oculus Lipsync, 1 in all: what a mouth shows. */
  weights: Float32Array<ArrayBuffer>;
}

/** Samples of one call of the library. */
const block = 1024;
const visemes = 15;

/**
 * Hears visemes in the sound of speech of any language, 52.5 ms behind it. Has an instance of the library of its own, so that it
 * runs in the thread of the sound, which has no TextDecoder and no fetch.
 */
export class Listener {
  private readonly functions: ListenFunctions;
  private readonly listener: number;
  private readonly samples: number;
  private readonly taken: number;
  private readonly heard: number;

  /** `library`: `semblante_listen.wasm`, compiled. `sampleRate`: 8000 to 192000 Hz, else RangeError. */
  constructor(library: WebAssembly.Module, sampleRate: number) {
    const functions = new WebAssembly.Instance(library, {}).exports as unknown as ListenFunctions;
    functions._initialize();
    this.functions = functions;
    this.samples = functions.malloc(4 * block);
    this.taken = functions.malloc(4);
    this.heard = functions.malloc(heardLayout.bytes);
    const options = functions.malloc(listenerOptionsLayout.bytes);
    if (!this.samples || !this.taken || !this.heard || !options) throw new Error('the listener has no memory');
    const view = this.view();
    view.setUint32(options, listenerOptionsLayout.bytes, true);
    view.setUint32(options + listenerOptionsLayout.sample_rate, sampleRate, true);
    view.setUint32(this.heard, heardLayout.bytes, true);
    const result = functions.semblante_listener_create(options, this.taken, 0);
    if (result !== 0) throw new RangeError(`a listener of ${sampleRate} samples a second cannot be made`);
    this.listener = this.view().getUint32(this.taken, true);
    functions.free(options);
  }

  /** Takes samples of one channel, of full scale 1, and hands on each 10 ms that were heard. */
  push(samples: Float32Array, onHeard: (heard: Heard) => void): void {
    for (let first = 0; first < samples.length; first += block) {
      const part = samples.subarray(first, first + block);
      new Float32Array(this.functions.memory.buffer, this.samples, part.length).set(part);
      let at = 0;
      while (this.functions.semblante_listener_push(this.listener, this.samples + 4 * at, part.length - at, this.taken, this.heard) === 0) {
        const view = this.view();
        at += view.getUint32(this.taken, true);
        const weights = this.heard + heardLayout.weights;
        onHeard({
          time: view.getFloat64(this.heard + heardLayout.time, true),
          level: view.getFloat32(this.heard + heardLayout.level, true),
          weights: new Float32Array(view.buffer.slice(weights, weights + 4 * visemes) as ArrayBuffer),
        });
      }
    }
  }

  private view(): DataView {
    return new DataView(this.functions.memory.buffer);
  }
}

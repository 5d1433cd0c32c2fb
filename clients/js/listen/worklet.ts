/** The part of a listener that runs in the thread of the sound: a file of its own, `listen_worklet.js`. */
import { Listener, type Heard } from './listener.ts';

// What an AudioWorkletGlobalScope has; the DOM's declarations do not.
declare const sampleRate: number;
declare class AudioWorkletProcessor {
  readonly port: MessagePort;
}
declare function registerProcessor(name: string, processor: new (options: { processorOptions: ListenOptions }) => AudioWorkletProcessor): void;
declare const currentTime: number;

export interface ListenOptions {
  library: WebAssembly.Module;
}

/** What the thread of the sound tells: what was heard, and when that sound came into the graph, s of its clock. */
export interface HeardMessage extends Heard {
  at: number;
}

class ListenProcessor extends AudioWorkletProcessor {
  private readonly listener: Listener;
  /** Samples so far. */
  private pushed = 0;

  constructor({ processorOptions }: { processorOptions: ListenOptions }) {
    super();
    this.listener = new Listener(processorOptions.library, sampleRate);
  }

  process(inputs: Float32Array[][]): boolean {
    const sound = inputs[0]?.[0];
    if (!sound) return true; // the microphone is not connected yet
    // Blocks that a busy machine loses are in the clock, but not among the samples.
    const begin = currentTime - this.pushed / sampleRate;
    this.pushed += sound.length;
    this.listener.push(sound, (heard) => {
      const message: HeardMessage = { ...heard, at: begin + heard.time / 1000 };
      this.port.postMessage(message, [heard.weights.buffer]);
    });
    return true;
  }
}

registerProcessor('semblante-listener', ListenProcessor);

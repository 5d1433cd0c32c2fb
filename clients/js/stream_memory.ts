import { clockLayout, eventLayout, headerLayout, streamOptionsLayout } from './generated/layouts.ts';
import type { Runtime } from './runtime.ts';

/** The library's side of a client: the handle of its stream, and memory for what is passed. */
export class StreamMemory {
  readonly stream: number;
  readonly event: number;
  readonly header: number;
  readonly clock: number;
  /** for results by pointer */
  readonly result: number;
  /** Received bytes and published frames: grows to the largest. */
  private buffer = 0;
  private capacity = 0;

  constructor(
    readonly runtime: Runtime,
    options: (view: DataView, at: number) => void,
  ) {
    const { semblante_stream_create: create } = runtime.functions;
    this.stream = runtime.create(streamOptionsLayout.bytes, options, create);
    this.result = runtime.alloc(8);
    this.event = runtime.struct(eventLayout.bytes);
    this.header = runtime.struct(headerLayout.bytes);
    this.clock = runtime.struct(clockLayout.bytes);
  }

  room(bytes: number): number {
    if (bytes > this.capacity) {
      this.runtime.free(this.buffer);
      this.capacity = 0;
      this.buffer = this.runtime.alloc(Math.ceil(bytes / 4096) * 4096);
      this.capacity = Math.ceil(bytes / 4096) * 4096;
    }
    return this.buffer;
  }

  release(): void {
    this.runtime.functions.semblante_stream_destroy(this.stream);
    for (const at of [this.event, this.header, this.clock, this.result, this.buffer]) this.runtime.free(at);
  }
}

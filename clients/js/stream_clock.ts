import { clockLayout } from './generated/layouts.ts';
import type { StreamMemory } from './stream_memory.ts';

/** SEMBLANTE_OK */
const ok = 0;

/** The estimate of a stream's clock. Times in ms; NaN until they are known. */
export class StreamClock {
  constructor(
    private readonly memory: () => StreamMemory | null,
    private readonly now: () => number,
  ) {}

  /** The stream's clock at the client's time `local`. */
  at(local: number): number {
    return this.read(clockLayout.media_time, local);
  }

  /** The stream's clock now. */
  get mediaTime(): number {
    return this.at(this.now());
  }

  /** Bound of the estimate's error. */
  get uncertainty(): number {
    return this.read(clockLayout.uncertainty);
  }

  /** Of the newest answer. */
  get roundTrip(): number {
    return this.read(clockLayout.round_trip);
  }

  /** How much faster the stream's clock runs than the client's, ms per ms; 0 until it is known. */
  get drift(): number {
    return this.read(clockLayout.drift) || 0;
  }

  /** Number of detected clock steps: a clock was set, or a machine slept. */
  get steps(): number {
    const memory = this.ask(this.now());
    return memory === null ? 0 : memory.runtime.view.getUint32(memory.clock + clockLayout.steps, true);
  }

  private read(member: number, local = this.now()): number {
    const memory = this.ask(local);
    return memory === null ? NaN : memory.runtime.view.getFloat64(memory.clock + member, true);
  }

  private ask(local: number): StreamMemory | null {
    const memory = this.memory();
    if (memory === null) return null;
    const { functions } = memory.runtime;
    return functions.semblante_stream_clock(memory.stream, local, memory.clock) === ok ? memory : null;
  }
}

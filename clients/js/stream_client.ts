import type { TimedFrame } from '../../protocol/ts/face_frame.ts';
import { binarySubprotocol, limits, type Header, type VoiceState } from '../../protocol/ts/messages.ts';
import { ProtocolError } from '../../protocol/ts/protocol_error.ts';
import { standardQuantizers, type QuantizerSteps } from '../../protocol/ts/quantizers.ts';
import { Emitter } from './emitter.ts';
import { writeFrame } from './frames.ts';
import { streamOptionsLayout, timedFrameLayout } from './generated/layouts.ts';
import { Runtime } from './runtime.ts';
import type { UnpackText } from './speech/library.ts';
import { StreamClock } from './stream_clock.ts';
import { eventType, readClock, readCloseCode, readEnd, readFault, readFrames, readHeader, readRefusal, readSound, readState, readText, readType } from './stream_events.ts';
import { StreamMemory } from './stream_memory.ts';
import type { ClientSocket, ConnectionState, StreamEvents, StreamOptions } from './stream_types.ts';

/** The subprotocol that carries a token; the server does not say it back. */
const bearerSubprotocol = 'semblante.bearer.';

/** When the socket has more buffered bytes than this, a publisher's frames are dropped instead of queued. */
const maxBufferedBytes = 256 * 1024;

/** First byte of a `text` in its packed form. */
const packedTextType = 13;
/** The enumeration of semblante.h, in order. */
const voiceStates: readonly VoiceState[] = ['reached', 'ended', 'failed', 'ready'];
const ok = 0;

/** "http://host:8080", "demo" -> "ws://host:8080/v1/streams/demo" */
export function streamUrl(baseUrl: string, streamId: string): string {
  return `${baseUrl.replace(/^http/, 'ws').replace(/\/$/, '')}/v1/streams/${encodeURIComponent(streamId)}`;
}

/**
 * A connection to one stream, as subscriber or publisher. Moves the bytes of a WebSocket; libsemblante reads and writes
 * them, comes back after a loss with growing pauses, and resumes the stream. All results and errors are events; nothing is
 * thrown after `connect`. Before the library is loaded `connect` waits for it.
 */
export class StreamClient extends Emitter<StreamEvents> {
  readonly url: string;
  state: ConnectionState = 'closed';
  header: Header | null = null;
  /** FAP units per level in the frames of this stream. */
  steps: QuantizerSteps = standardQuantizers;
  /** Estimate of the stream's clock relative to `now()`. */
  readonly streamClock: StreamClock;

  private readonly options: Required<Omit<StreamOptions, 'token'>> & Pick<StreamOptions, 'token'>;
  private memory: StreamMemory | null = null;
  private release: (() => void) | null = null;
  private readonly whenMade: ((memory: StreamMemory) => void)[] = [];
  private isWanted = false;
  private socket: ClientSocket | null = null;
  private unpack: UnpackText | null = null;
  private waiting: Uint8Array[] | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** When it fires; it may be earlier than the library has something to do. */
  private timerAt = Infinity;

  constructor(url: string, options: StreamOptions = {}) {
    super();
    this.url = url;
    this.options = {
      role: 'subscribe',
      takeOver: false,
      sound: false,
      text: false,
      captions: false,
      WebSocket: globalThis.WebSocket,
      now: () => performance.now(),
      backoff: { first: 250, longest: 10_000 },
      pingInterval: 5000,
      ...options,
    };
    this.streamClock = new StreamClock(() => this.memory, this.options.now);
  }

  connect(): void {
    this.isWanted = true;
    if (this.memory === null) this.become('connecting');
    Runtime.whenLoaded((runtime) => {
      if (!this.isWanted) return;
      const { stream } = this.made(runtime);
      runtime.functions.semblante_stream_start(stream, this.options.now());
      this.act();
    });
  }

  /** Closes without reconnecting; `connect` opens again and resumes. */
  close(): void {
    this.isWanted = false;
    if (this.memory === null) return this.become('closed');
    this.memory.runtime.functions.semblante_stream_stop(this.memory.stream, this.options.now());
    this.act();
  }

  /** Closes and frees the memory of the library. Players that follow this client follow nobody then. */
  dispose(): void {
    this.close();
    clearTimeout(this.timer);
    this.release?.();
    this.release = this.memory = null;
  }

  /** The library's stream while it may send: the connection is open and not congested. */
  private get clearMemory(): StreamMemory | null {
    const isClear = this.state === 'open' && this.socket !== null && this.socket.bufferedAmount <= maxBufferedBytes;
    return isClear ? this.memory : null;
  }

  /**
   * Sends frames as a publisher. `mediaTime` in ms, 0: now; the times of the frames are relative to it. Returns false
   * and sends nothing while the stream is not open or the connection is congested.
   */
  publish(frames: readonly TimedFrame[], mediaTime = 0): boolean {
    const memory = this.clearMemory;
    if (memory === null || frames.length === 0 || frames.length > limits.max_frames_per_message) return false;
    const { runtime, stream } = memory;
    const at = memory.room(frames.length * timedFrameLayout.bytes);
    const { view } = runtime;
    frames.forEach(({ time, state }, i) => {
      const frame = at + i * timedFrameLayout.bytes;
      view.setFloat64(frame, time, true);
      writeFrame(view, frame + timedFrameLayout.frame, state, this.steps);
    });
    const result = runtime.functions.semblante_stream_publish(stream, at, frames.length, mediaTime, this.options.now());
    this.act();
    return result === ok;
  }

  /**
   * Sends one Opus packet as a publisher with `sound`: of at most 4000 bytes and 120 ms, without pre-skip, first heard at `mediaTime`, ms
   * of the clock of the frames; packets do not overlap. Returns false and sends nothing while the stream is not open, the connection is
   * congested, or the server takes no sound.
   */
  publishSound(packet: Uint8Array, mediaTime: number): boolean {
    const memory = this.clearMemory;
    if (memory === null) return false;
    const { runtime, stream } = memory;
    const at = memory.room(packet.byteLength);
    runtime.bytes.set(packet, at);
    const result = runtime.functions.semblante_stream_publish_sound(stream, at, packet.byteLength, mediaTime);
    this.act();
    return result === ok;
  }

  /**
   * Tells the server what the client's own voice does: it has `reached` the word at a character (code points) of a text, or `ended`
   * it; it is `ready`, and text comes in place of frames of speech from now on; or it has `failed`, and frames come. The last two
   * also hold for later connections.
   */
  spoken(state: VoiceState, speech = 0, character = 0): void {
    this.withStream(({ runtime, stream }) => {
      runtime.functions.semblante_stream_spoken(stream, voiceStates.indexOf(state), BigInt(speech), character, this.options.now());
      this.act();
    });
  }

  /** Whether text comes beside the frames and the sound of speech, from now on and after a new connection. */
  setCaptions(on: boolean): void {
    this.withStream(({ runtime, stream }) => {
      runtime.functions.semblante_stream_set_captions(stream, on ? 1 : 0);
      this.act();
    });
  }

  /** Sends several pings quickly, after a pause in which the machine may have slept. Their pongs are `clock` events. */
  measureClock(): void {
    if (this.memory === null) return;
    this.memory.runtime.functions.semblante_stream_measure_clock(this.memory.stream, this.options.now());
    this.act();
  }

  /** For the player: calls `use` with the library's stream, now or when it is made. */
  withStream(use: (memory: StreamMemory) => void): void {
    if (this.memory) use(this.memory);
    else this.whenMade.push(use);
  }

  private made(runtime: Runtime): StreamMemory {
    if (this.memory) return this.memory;
    const { role, takeOver, sound, text, captions, backoff, pingInterval } = this.options;
    const memory = new StreamMemory(runtime, (view, at) => {
      const of = streamOptionsLayout;
      view.setUint32(at + of.role, role === 'publish' ? 1 : 0, true);
      view.setUint32(at + of.take_over, takeOver ? 1 : 0, true);
      view.setFloat64(at + of.retry_first, backoff.first || -1, true);
      view.setFloat64(at + of.retry_longest, backoff.longest || -1, true);
      view.setUint32(at + of.seed, Math.random() * 4294967296, true);
      view.setUint32(at + of.seed + 4, Math.random() * 4294967296, true);
      view.setFloat64(at + of.ping_interval, pingInterval || -1, true);
      view.setUint32(at + of.sound, sound ? 1 : 0, true);
      view.setUint32(at + of.text, text ? 1 : 0, true);
      view.setUint32(at + of.captions, captions ? 1 : 0, true);
    });
    this.memory = memory;
    this.release = runtime.owns(this, releaseStream, memory);
    for (const use of this.whenMade.splice(0)) use(memory);
    return memory;
  }

  /** Does what the library asks for: events, bytes to send, and the time to call it again. */
  private act(): void {
    const { memory } = this;
    if (memory === null) return;
    const { runtime, stream } = memory;
    const { functions } = runtime;
    while (this.memory === memory && functions.semblante_stream_next_event(stream, memory.event) !== 0) {
      this.handle(memory);
    }
    if (this.memory !== memory) return;
    for (;;) {
      const bytes = functions.semblante_stream_take_bytes(stream, memory.result);
      if (bytes === 0) break;
      const size = runtime.view.getUint32(memory.result, true);
      this.socket?.send(runtime.bytes.slice(bytes, bytes + size) as Uint8Array<ArrayBuffer>);
    }
    const wake = functions.semblante_stream_wake_time(stream);
    if (wake < this.timerAt) this.wakeAt(wake);
  }

  private wakeAt(wake: number): void {
    clearTimeout(this.timer);
    this.timerAt = wake;
    this.timer = setTimeout(() => this.wake(wake), Math.max(0, Math.ceil(wake - this.options.now())));
  }

  private wake(at: number): void {
    this.timerAt = Infinity;
    if (this.memory === null) return;
    this.memory.runtime.functions.semblante_stream_tick(this.memory.stream, Math.max(at, this.options.now()));
    this.act();
  }

  private handle(memory: StreamMemory): void {
    const type = readType(memory);
    switch (type) {
      case eventType.state:
        return this.become(readState(memory));
      case eventType.connect:
        return this.open();
      case eventType.close: {
        const { socket } = this;
        this.socket = null;
        return socket?.close(readCloseCode(memory));
      }
      case eventType.header:
        return this.takeHeader(memory);
      case eventType.keyframe:
      case eventType.frames:
        return this.takeFrames(memory, type === eventType.keyframe);
      case eventType.sound:
        return this.emit('sound', readSound(memory));
      case eventType.text:
        return this.emit('text', readText(memory));
      case eventType.clock:
        return this.emit('clock', readClock(memory));
      case eventType.refused:
        return this.emit('error', readRefusal(memory));
      case eventType.fault:
        return this.emit('fault', readFault(memory));
      case eventType.end:
        return this.emit('end', readEnd(memory));
    }
  }

  private takeHeader(memory: StreamMemory): void {
    const read = readHeader(memory);
    if (!read) return;
    this.steps = read.steps;
    this.header = read.header;
    this.emit('header', read.header);
  }

  private takeFrames(memory: StreamMemory, isKeyframe: boolean): void {
    if (!this.has(isKeyframe ? 'keyframe' : 'frames')) return; // a player reads them in the library
    const read = readFrames(memory, this.steps);
    if (!read) return;
    const { frames, ...of } = read;
    if (isKeyframe) this.emit('keyframe', { type: 'keyframe', ...of, state: frames[0]!.state });
    else this.emit('frames', { type: 'frames', ...of, frames });
  }

  private become(state: ConnectionState): void {
    if (state === this.state) return;
    this.state = state;
    this.emit('state', state);
  }

  private open(): void {
    const { token, WebSocket } = this.options;
    const names = token === undefined ? [binarySubprotocol] : [binarySubprotocol, `${bearerSubprotocol}${token}`];
    let socket: ClientSocket;
    try {
      if (!WebSocket) throw new Error("there is no WebSocket here: give the option WebSocket, as of the package 'ws'");
      socket = new WebSocket(this.url, names);
    } catch (error) {
      // An address that is none of a WebSocket, or that this page may not open: the next attempt would fail likewise.
      this.emit('fault', new ProtocolError('invalid_argument', '', `${this.url}: ${error instanceof Error ? error.message : String(error)}`));
      return this.close();
    }
    this.socket = socket;
    this.waiting = null;
    socket.binaryType = 'arraybuffer';
    const current = (call: (memory: StreamMemory, now: number) => void) => (): void => {
      if (socket !== this.socket || this.memory === null) return;
      call(this.memory, this.options.now());
      this.act();
    };
    socket.onopen = current(({ runtime, stream }, now) => runtime.functions.semblante_stream_opened(stream, now));
    // In Node up to 22 no close event follows the error of a connection that cannot be made.
    socket.onclose = socket.onerror = current(({ runtime, stream }, now) => {
      this.socket = null;
      runtime.functions.semblante_stream_closed(stream, 0, now);
    });
    socket.onmessage = (event: MessageEvent<ArrayBuffer | string>) => {
      // A text is no message of this subprotocol: the library finds its byte unreadable.
      if (socket === this.socket) this.receive(typeof event.data === 'string' ? new Uint8Array(1) : new Uint8Array(event.data));
    };
  }

  private receive(bytes: Uint8Array): void {
    if (this.waiting) this.waiting.push(bytes);
    else if (bytes[0] === packedTextType) this.receiveText(bytes);
    else this.take(bytes);
  }

  /** A packed text needs a part of the library that others do not load; what comes meanwhile waits. */
  private receiveText(packed: Uint8Array): void {
    if (this.unpack) return this.take(this.unpack(packed) ?? packed); // what is none, the stream refuses
    const { socket } = this;
    const waiting = (this.waiting = [packed]);
    void import('./speech/library.ts')
      .then(({ loadUnpacking }) => loadUnpacking())
      .catch(() => null)
      .then((unpack) => {
        if (this.waiting !== waiting || this.socket !== socket) return; // another connection
        this.waiting = null;
        this.unpack = unpack;
        for (const bytes of waiting) if (unpack !== null || bytes[0] !== packedTextType) this.receive(bytes);
      });
  }

  private take(bytes: Uint8Array): void {
    const { memory } = this;
    if (memory === null) return;
    const at = memory.room(bytes.length);
    memory.runtime.bytes.set(bytes, at);
    memory.runtime.functions.semblante_stream_receive(memory.stream, at, bytes.length, this.options.now());
    if (this.has('message')) this.emit('message', undefined);
    this.act();
  }
}

function releaseStream(memory: StreamMemory): void {
  memory.release();
}

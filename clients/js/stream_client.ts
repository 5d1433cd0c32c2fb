import type { TimedFrame } from '../../protocol/ts/face_frame.ts';
import { FrameDecoder, FrameEncoder } from '../../protocol/ts/frame_codec.ts';
import { decodeJson, encodeJson } from '../../protocol/ts/json_codec.ts';
import {
  binarySubprotocol,
  jsonSubprotocol,
  protocolVersion,
  type End,
  type Frames,
  type Header,
  type Keyframe,
  type Message,
  type Pong,
  type ResumePoint,
  type StreamError,
  type StreamRole,
} from '../../protocol/ts/messages.ts';
import { ProtocolError } from '../../protocol/ts/protocol_error.ts';
import { quantizersOf, standardQuantizers, type QuantizerSteps } from '../../protocol/ts/quantizers.ts';
import { ClockEstimate, pingPause } from './clock_estimate.ts';
import { Emitter } from './emitter.ts';

export type ConnectionState = 'connecting' | 'open' | 'waiting' | 'closed';

export interface StreamEvents {
  /** connecting, open (header came), waiting (to connect again), closed (for good) */
  state: ConnectionState;
  header: Header;
  keyframe: Keyframe;
  frames: Frames;
  end: End;
  /** The server refused something we sent. */
  error: StreamError;
  /** Something the server sent could not be read. The client connects again where that helps. */
  fault: ProtocolError;
  clock: ClockSample;
}

/** One measurement of the server's clock. Times in ms. */
export interface ClockSample {
  roundTrip: number;
  /** Server's wall clock minus ours (`now()`). */
  offset: number;
  /** Of the stream, at the moment the pong came, by the same estimate. */
  mediaTime: number;
}

export interface StreamOptions {
  role?: StreamRole;
  subprotocol?: 'binary' | 'json';
  /** Of a publisher: to replace the one there is. Default false. */
  takeOver?: boolean;
  /** Default: the platform's. Node 18 has none: pass that of a package. */
  WebSocket?: new (url: string, protocols: string[]) => WebSocket;
  /** ms; default performance.now() */
  now?: () => number;
  /** First and longest pause before connecting again, ms. Default 250 and 10000; each try doubles it. */
  backoff?: { first: number; longest: number };
  /** ms between pings at the most, 0: none. Default 5000. They come quicker after connecting, and where answers jitter. */
  pingInterval?: number;
}

/** More waiting than this in the socket, and a publisher's frames are left out rather than queued. */
const maxBufferedBytes = 256 * 1024;

/** "http://host:8080", "demo" -> "ws://host:8080/v1/streams/demo" */
export function streamUrl(baseUrl: string, streamId: string): string {
  return `${baseUrl.replace(/^http/, 'ws').replace(/\/$/, '')}/v1/streams/${encodeURIComponent(streamId)}`;
}

/**
 * One stream, subscribed or published to. Connects again after a loss, with pauses that grow, and resumes where it
 * stopped. The events tell everything; nothing is thrown after `connect`.
 */
export class StreamClient extends Emitter<StreamEvents> {
  readonly url: string;
  state: ConnectionState = 'closed';
  header: Header | null = null;
  /** FAP units per level in the frames of this stream. */
  steps: QuantizerSteps = standardQuantizers;
  /** What is known of the stream's clock, against `now()`. */
  readonly streamClock = new ClockEstimate();

  private readonly options: Required<StreamOptions>;
  private socket: WebSocket | null = null;
  private decoder = new FrameDecoder();
  private encoder: FrameEncoder | null = null;
  private resume: ResumePoint | null = null;
  private attempts = 0;
  private retryTimer: ReturnType<typeof setTimeout> | undefined;
  private pingTimer: ReturnType<typeof setTimeout> | undefined;
  private pingId = 0;
  /** Since the header, or since the clock was to be measured anew. */
  private pings = 0;
  private helloTime = NaN;

  constructor(url: string, options: StreamOptions = {}) {
    super();
    this.url = url;
    this.options = {
      role: 'subscribe',
      subprotocol: 'binary',
      takeOver: false,
      WebSocket: globalThis.WebSocket,
      now: () => performance.now(),
      backoff: { first: 250, longest: 10_000 },
      pingInterval: 5000,
      ...options,
    };
  }

  connect(): void {
    if (this.socket) return;
    clearTimeout(this.retryTimer);
    this.become('connecting');
    const name = this.options.subprotocol === 'json' ? jsonSubprotocol : binarySubprotocol;
    const socket = new this.options.WebSocket(this.url, [name]);
    this.socket = socket;
    this.decoder = new FrameDecoder();
    this.encoder = null;
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.helloTime = this.options.now();
      this.send({
        type: 'hello',
        version: protocolVersion,
        role: this.options.role,
        resume: this.resume,
        coding: name === binarySubprotocol ? 'packed' : 'plain',
        take_over: this.options.takeOver,
      });
    };
    socket.onmessage = (event: MessageEvent<ArrayBuffer | string>) => {
      if (socket === this.socket) this.receive(event.data);
    };
    socket.onclose = () => {
      if (socket === this.socket) this.lost();
    };
    socket.onerror = () => undefined; // a close follows
  }

  /** Closes for good; `connect` opens again. */
  close(): void {
    const socket = this.socket;
    this.socket = null;
    clearTimeout(this.retryTimer);
    clearTimeout(this.pingTimer);
    socket?.close(1000);
    this.become('closed');
  }

  /**
   * Sends frames, for a publisher. `mediaTime` in ms, 0: now; the frames' own times are after it. Returns false, and
   * sends nothing, while the stream is not open or the connection does not keep up.
   */
  publish(frames: TimedFrame[], mediaTime = 0): boolean {
    if (this.state !== 'open' || !this.socket || frames.length === 0) return false;
    if (this.socket.bufferedAmount > maxBufferedBytes) return false;
    let rest = frames;
    if (!this.encoder) {
      // What follows is differences, so the first frame on a connection is a whole state.
      this.encoder = new FrameEncoder();
      const { time, state } = frames[0]!;
      this.send({ type: 'keyframe', sequence: 0, media_time: mediaTime === 0 ? 0 : mediaTime + time, state });
      rest = frames.slice(1);
    }
    if (rest.length > 0) this.send({ type: 'frames', sequence: 0, media_time: mediaTime, frames: rest });
    return true;
  }

  /** Asks for the clocks; the answer is the event `clock`. */
  ping(): void {
    if (this.state !== 'open') return;
    this.pingId = (this.pingId + 1) >>> 0;
    this.send({ type: 'ping', id: this.pingId, client_time: this.options.now() });
  }

  /** Asks for the clocks a few times at once: after a pause in which this machine may have slept. */
  measureClock(): void {
    if (this.state !== 'open' || this.options.pingInterval <= 0) return;
    this.pings = 0;
    this.pingOn();
  }

  private pingOn(): void {
    clearTimeout(this.pingTimer);
    this.ping();
    this.pings += 1;
    const pause = pingPause(this.pings, this.streamClock.uncertainty, this.options.pingInterval);
    this.pingTimer = setTimeout(() => this.pingOn(), Math.min(pause, this.options.pingInterval));
  }

  private become(state: ConnectionState): void {
    if (state === this.state) return;
    this.state = state;
    this.emit('state', state);
  }

  private send(message: Message): void {
    if (!this.socket) return;
    if (this.options.subprotocol === 'json') {
      this.socket.send(encodeJson(message, this.steps));
    } else {
      this.socket.send((this.encoder ?? new FrameEncoder()).encode(message) as Uint8Array<ArrayBuffer>);
    }
  }

  private receive(data: ArrayBuffer | string): void {
    let message: Message;
    try {
      message = typeof data === 'string' ? decodeJson(data, this.steps) : this.decoder.decode(new Uint8Array(data));
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      if (error.code === 'unsupported' && error.where === '/type') return; // of a later version: not for us
      this.emit('fault', error);
      // Whatever was missed is missing in every later difference: only a new start helps.
      this.socket?.close(4000, 'unreadable message');
      return;
    }
    this.handle(message);
  }

  private handle(message: Message): void {
    switch (message.type) {
      case 'header':
        if (this.header && this.header.epoch !== message.epoch) this.streamClock.clear();
        this.streamClock.answered(this.helloTime, this.options.now(), message.media_time);
        this.header = message;
        this.steps = quantizersOf(message);
        if (this.resume?.epoch !== message.epoch) this.resume = { epoch: message.epoch, sequence: message.sequence };
        this.attempts = 0;
        this.emit('header', message);
        this.become('open');
        this.measureClock();
        return;
      case 'keyframe':
        if (this.resume) this.resume.sequence = message.sequence;
        return this.emit('keyframe', message);
      case 'frames':
        if (this.resume) this.resume.sequence = message.sequence + message.frames.length - 1;
        return this.emit('frames', message);
      case 'end':
        this.emit('end', message);
        // A stream that is over is not asked for again; one whose server stops is.
        if (message.reason === 'finished' || message.reason === 'deleted' || message.reason === 'replaced') this.close();
        return;
      case 'error':
        this.encoder = null; // the server may lack a frame that the next would be a difference to
        return this.emit('error', message);
      case 'pong':
        return this.emit('clock', this.clockOf(message));
      default:
        return; // hello and ping are not for clients
    }
  }

  private clockOf(pong: Pong): ClockSample {
    const now = this.options.now();
    const roundTrip = Math.max(0, now - pong.client_time);
    this.streamClock.answered(pong.client_time, now, pong.media_time);
    return { roundTrip, offset: pong.server_time + roundTrip / 2 - now, mediaTime: pong.media_time + roundTrip / 2 };
  }

  private lost(): void {
    this.socket = null;
    clearTimeout(this.pingTimer);
    const { first, longest } = this.options.backoff;
    // Half of the pause is chance, so that a thousand clients do not come back in the same moment.
    const pause = Math.min(longest, first * 2 ** this.attempts) * (0.5 + Math.random() / 2);
    this.attempts += 1;
    this.become('waiting');
    this.retryTimer = setTimeout(() => this.connect(), pause);
  }
}

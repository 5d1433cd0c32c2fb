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
  /** connecting, open (header received), waiting (to reconnect), closed (permanently) */
  state: ConnectionState;
  header: Header;
  keyframe: Keyframe;
  frames: Frames;
  end: End;
  /** The server refused a message of this client. */
  error: StreamError;
  /** A message of the server could not be decoded. The client reconnects if necessary. */
  fault: ProtocolError;
  clock: ClockSample;
}

/** One measurement of the server's clock. Times in ms. */
export interface ClockSample {
  roundTrip: number;
  /** Server's wall clock minus the client's clock (`now()`). */
  offset: number;
  /** Media time of the stream when the pong arrived, by the clock estimate. */
  mediaTime: number;
}

export interface StreamOptions {
  role?: StreamRole;
  subprotocol?: 'binary' | 'json';
  /** For a publisher: replace the current publisher. Default false. */
  takeOver?: boolean;
  /**
   * For a server that asks for tokens, from a page that is not its own: sent as a subprotocol, because a browser's
   * WebSocket carries no header.
   */
  token?: string;
  /** Default: the platform's WebSocket. Node 18 has none: pass the class of a package. */
  WebSocket?: new (url: string, protocols: string[]) => WebSocket;
  /** ms; default performance.now() */
  now?: () => number;
  /** First and longest pause before a reconnection, ms. Default 250 and 10000; each attempt doubles the pause. */
  backoff?: { first: number; longest: number };
  /**
   * Maximum time between pings, ms; 0: no pings. Default 5000. Shorter after connecting and when round trips jitter.
   */
  pingInterval?: number;
}

/** The subprotocol that carries a token; the server does not say it back. */
const bearerSubprotocol = 'semblante.bearer.';

/** When the socket has more buffered bytes than this, a publisher's frames are dropped instead of queued. */
const maxBufferedBytes = 256 * 1024;

/** "http://host:8080", "demo" -> "ws://host:8080/v1/streams/demo" */
export function streamUrl(baseUrl: string, streamId: string): string {
  return `${baseUrl.replace(/^http/, 'ws').replace(/\/$/, '')}/v1/streams/${encodeURIComponent(streamId)}`;
}

/**
 * A connection to one stream, as subscriber or publisher. Reconnects after a loss with exponential backoff and resumes
 * the stream. All results and errors are events; nothing is thrown after `connect`.
 */
export class StreamClient extends Emitter<StreamEvents> {
  readonly url: string;
  state: ConnectionState = 'closed';
  header: Header | null = null;
  /** FAP units per level in the frames of this stream. */
  steps: QuantizerSteps = standardQuantizers;
  /** Estimate of the stream's clock relative to `now()`. */
  readonly streamClock = new ClockEstimate();

  private readonly options: Required<Omit<StreamOptions, 'token'>> & Pick<StreamOptions, 'token'>;
  private socket: WebSocket | null = null;
  private decoder = new FrameDecoder();
  private encoder: FrameEncoder | null = null;
  private resume: ResumePoint | null = null;
  private attempts = 0;
  private retryTimer: ReturnType<typeof setTimeout> | undefined;
  private pingTimer: ReturnType<typeof setTimeout> | undefined;
  private pingId = 0;
  /** Pings sent since the header, or since `measureClock`. */
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
    const { token } = this.options;
    const names = token === undefined ? [name] : [name, `${bearerSubprotocol}${token}`];
    const socket = new this.options.WebSocket(this.url, names);
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
    socket.onerror = () => undefined; // a close event follows
  }

  /** Closes without reconnecting; `connect` opens again. */
  close(): void {
    const socket = this.socket;
    this.socket = null;
    clearTimeout(this.retryTimer);
    clearTimeout(this.pingTimer);
    socket?.close(1000);
    this.become('closed');
  }

  /**
   * Sends frames as a publisher. `mediaTime` in ms, 0: now; the times of the frames are relative to it. Returns false
   * and sends nothing while the stream is not open or the connection is congested.
   */
  publish(frames: TimedFrame[], mediaTime = 0): boolean {
    if (this.state !== 'open' || !this.socket || frames.length === 0) return false;
    if (this.socket.bufferedAmount > maxBufferedBytes) return false;
    let rest = frames;
    if (!this.encoder) {
      // Later messages are differences, so the first frame of a connection must be a keyframe.
      this.encoder = new FrameEncoder();
      const { time, state } = frames[0]!;
      this.send({ type: 'keyframe', sequence: 0, media_time: mediaTime === 0 ? 0 : mediaTime + time, state });
      rest = frames.slice(1);
    }
    if (rest.length > 0) this.send({ type: 'frames', sequence: 0, media_time: mediaTime, frames: rest });
    return true;
  }

  /** Sends a ping; its pong becomes the event `clock`. */
  ping(): void {
    if (this.state !== 'open') return;
    this.pingId = (this.pingId + 1) >>> 0;
    this.send({ type: 'ping', id: this.pingId, client_time: this.options.now() });
  }

  /** Sends several pings quickly, after a pause in which the machine may have slept. */
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
      if (error.code === 'unsupported' && error.where === '/type') return; // a message type of a later version: ignored
      this.emit('fault', error);
      // All later differences depend on the lost message, so only a new connection helps.
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
        // Do not reconnect to a stream that has ended; do reconnect when the server restarts.
        if (message.reason === 'finished' || message.reason === 'deleted' || message.reason === 'replaced') this.close();
        return;
      case 'error':
        this.encoder = null; // the server may lack the base frame of the next difference
        return this.emit('error', message);
      case 'pong':
        return this.emit('clock', this.clockOf(message));
      default:
        return; // hello and ping are sent by clients only
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
    // Half of the pause is random, so that many clients do not reconnect at the same moment.
    const pause = Math.min(longest, first * 2 ** this.attempts) * (0.5 + Math.random() / 2);
    this.attempts += 1;
    this.become('waiting');
    this.retryTimer = setTimeout(() => this.connect(), pause);
  }
}

import { FrameDecoder, FrameEncoder } from '@protocol/frame_codec.ts';
import { binarySubprotocol, protocolVersion, type EndReason, type Header, type Message, type ResumePoint, type StreamRole } from '@protocol/messages.ts';
import { ProtocolError } from '@protocol/protocol_error.ts';

export interface LinkStatus {
  kind: 'off' | 'connecting' | 'open' | 'waiting' | 'ended';
  title?: string;
  reason?: string;
}

export interface LinkHandlers {
  onStatus: (status: LinkStatus) => void;
  onHeader: (header: Header) => void;
  onMessage: (message: Message) => void;
}

const endings: Record<EndReason, string> = {
  other: 'The stream ended.',
  finished: 'The performance is over.',
  deleted: 'The stream was deleted.',
  shutdown: 'The server is shutting down.',
  replaced: 'Another connection took over.',
  slow: 'This connection was too slow for the stream.',
};
const transient: readonly EndReason[] = ['shutdown', 'slow'];
const firstWait = 500;
const longestWait = 8000;

/** One WebSocket to a stream in the binary subprotocol, opened again when it breaks. */
export class StreamLink {
  bytes = 0;
  private socket: WebSocket | null = null;
  private decoder = new FrameDecoder();
  private encoder = new FrameEncoder();
  private timer: ReturnType<typeof setTimeout> | null = null;
  private wait = firstWait;
  private closed = false;
  private ended = false;

  constructor(
    private readonly url: string,
    private readonly title: string,
    private readonly role: StreamRole,
    private readonly resume: () => ResumePoint | null,
    private readonly handlers: LinkHandlers,
  ) {}

  open(): void {
    this.handlers.onStatus({ kind: 'connecting', title: this.title });
    let socket: WebSocket;
    try {
      socket = new WebSocket(this.url, binarySubprotocol);
    } catch {
      this.end('This page may not open a connection to the stream.');
      return;
    }
    this.socket = socket;
    this.decoder = new FrameDecoder();
    this.encoder = new FrameEncoder();
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => this.send({ type: 'hello', version: protocolVersion, role: this.role, resume: this.resume() });
    socket.onmessage = (event: MessageEvent<ArrayBuffer>) => this.take(event.data);
    socket.onclose = (event) => {
      if (this.socket === socket) this.lost(event.reason);
    };
  }

  close(): void {
    this.closed = true;
    if (this.timer !== null) clearTimeout(this.timer);
    const { socket } = this;
    this.socket = null;
    socket?.close(1000);
  }

  /** Sends if the connection stands; says whether it did. */
  send(message: Message): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(this.encoder.encode(message) as Uint8Array<ArrayBuffer>);
    return true;
  }

  /** Bytes that wait in the browser: above a few frames' worth the network does not keep up. */
  get pending(): number {
    return this.socket?.bufferedAmount ?? 0;
  }

  private take(data: ArrayBuffer): void {
    this.bytes += data.byteLength;
    let message: Message;
    try {
      message = this.decoder.decode(new Uint8Array(data));
    } catch (error) {
      if (error instanceof ProtocolError && error.code === 'unsupported') return;
      // Out of step with the server: a new connection starts from a keyframe.
      this.socket?.close(1002);
      return;
    }
    if (message.type === 'header') {
      this.wait = firstWait;
      this.handlers.onStatus({ kind: 'open', title: message.title || this.title });
      this.handlers.onHeader(message);
    } else if (message.type === 'end') {
      if (!transient.includes(message.reason)) this.end(endings[message.reason]);
    } else if (message.type === 'error') {
      this.handlers.onStatus({ kind: 'open', title: this.title, reason: message.where ? `${message.message} (${message.where})` : message.message });
    } else {
      this.handlers.onMessage(message);
    }
  }

  private end(reason: string): void {
    this.ended = true;
    this.handlers.onStatus({ kind: 'ended', title: this.title, reason });
  }

  private lost(reason: string): void {
    this.socket = null;
    if (this.closed || this.ended) return;
    this.handlers.onStatus({ kind: 'waiting', title: this.title, reason: reason || 'The connection is gone; trying again.' });
    this.timer = setTimeout(() => this.open(), this.wait);
    this.wait = Math.min(longestWait, this.wait * 2);
  }
}

import { StreamClient, type StreamOptions } from '../../../../clients/js/index.ts';
import { packedFramesType, packedKeyframeType, type Header, type Message } from '../../../../protocol/ts/index.ts';
import { FrameDecoder, FrameEncoder } from './plain_codec.ts';

/** A WebSocket whose other end is the test. It speaks the plain form, and reads the packed one by the library. */
export class FakeSocket {
  static sockets: FakeSocket[] = [];
  static get last(): FakeSocket {
    return FakeSocket.sockets[FakeSocket.sockets.length - 1]!;
  }

  binaryType = 'blob';
  bufferedAmount = 0;
  closedWith: number | undefined;
  onopen: (() => void) | null = null;
  onmessage: ((event: { data: ArrayBuffer | string }) => void) | null = null;
  onclose: (() => void) | null = null;
  onerror: (() => void) | null = null;
  readonly sent: Message[] = [];
  readonly url: string;
  readonly protocols: string[];
  private readonly encoder = new FrameEncoder();
  private readonly decoder = new FrameDecoder();
  private reader: FakeSocket | null = null;

  constructor(url: string, protocols: string[]) {
    this.url = url;
    this.protocols = protocols;
    if (url !== readerUrl) FakeSocket.sockets.push(this);
    else FakeSocket.newestReader = this;
  }
  private static newestReader: FakeSocket | null = null;

  // the client's side
  send(data: Uint8Array): void {
    const type = data[0]!;
    if (type === packedKeyframeType || type >= packedFramesType) this.packedReader().giveRaw(data.slice().buffer);
    else this.sent.push(this.decoder.decode(data));
  }
  close(code: number): void {
    this.closedWith = code;
    this.onclose?.();
  }

  // the server's side
  accept(): void {
    this.onopen?.();
  }
  give(message: Message): void {
    this.giveRaw(this.encoder.encode(message).buffer as ArrayBuffer);
  }
  giveRaw(data: ArrayBuffer | string): void {
    this.onmessage?.({ data });
  }
  drop(): void {
    this.onclose?.();
  }

  private packedReader(): FakeSocket {
    if (this.reader) return this.reader;
    const client = new StreamClient(readerUrl, {
      WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>,
      now: () => 0,
      pingInterval: 0,
    });
    client.on('keyframe', (keyframe) => this.sent.push(keyframe));
    client.on('frames', (frames) => this.sent.push(frames));
    client.on('fault', (fault) => {
      throw fault;
    });
    client.connect();
    this.reader = FakeSocket.newestReader!;
    this.reader.accept();
    this.reader.give(headerOf({}));
    return this.reader;
  }
}

const readerUrl = 'ws://reader';

export function headerOf(given: Partial<Header>): Header {
  return {
    type: 'header',
    version: 1,
    stream: 'demo',
    title: '',
    model: '',
    epoch: 9,
    sequence: 0,
    media_time: 0,
    server_time: 0,
    fps_hint: 25,
    batch_interval: 40,
    quantizers: [],
    recovered: false,
    viseme_share: null,
    coding: 'plain',
    ...given,
  };
}

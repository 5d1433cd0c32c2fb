import { FrameDecoder, FrameEncoder, decodeJson, encodeJson, type Message } from '../../../../protocol/ts/index.ts';

/** A WebSocket whose other end is the test. */
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

  constructor(url: string, protocols: string[]) {
    this.url = url;
    this.protocols = protocols;
    FakeSocket.sockets.push(this);
  }

  // the client's side
  send(data: Uint8Array | string): void {
    this.sent.push(typeof data === 'string' ? decodeJson(data) : this.decoder.decode(data));
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
    const json = this.protocols[0] === 'semblante.v1.json';
    this.giveRaw(json ? encodeJson(message) : (this.encoder.encode(message).buffer as ArrayBuffer));
  }
  giveRaw(data: ArrayBuffer | string): void {
    this.onmessage?.({ data });
  }
  drop(): void {
    this.onclose?.();
  }
}

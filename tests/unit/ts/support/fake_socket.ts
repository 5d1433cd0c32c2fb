import { StreamClient, type StreamOptions } from '../../../../clients/js/index.ts';
import { ByteReader, ByteWriter } from '../../../../protocol/ts/byte_io.ts';
import { messages, type Frames, type Header, type Keyframe, type Message } from '../../../../protocol/ts/messages.ts';
import { decodeMessage, encodeMessage } from './message_codec.ts';

/** A WebSocket whose other end is the test. The library codes the messages that carry a face. */
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
  private reader: Far | null = null;
  private writer: FaceWriter | null = null;

  constructor(url: string, protocols: string[]) {
    this.url = url;
    this.protocols = protocols;
    FakeSocket.sockets.push(this);
  }

  // the client's side
  send(data: Uint8Array): void {
    if (data[0] !== keyframeType && data[0]! < framesType) this.sent.push(decodeMessage(data));
    else this.faceReader().give(data);
  }
  close(code: number): void {
    this.closedWith = code;
    this.forget();
    this.onclose?.();
  }

  // the server's side
  accept(): void {
    this.onopen?.();
  }
  give(message: Message): void {
    if (message.type === 'keyframe') {
      this.writer?.far.client.dispose();
      this.writer = new FaceWriter();
    }
    this.giveRaw(this.coded(message).slice().buffer);
  }
  private coded(message: Message): Uint8Array {
    if (message.type === 'keyframe') return this.writer!.keyframe(message);
    if (message.type === 'frames') return this.writer!.frames(message);
    return encodeMessage(message);
  }
  giveRaw(data: ArrayBuffer | string): void {
    this.onmessage?.({ data });
  }
  drop(): void {
    this.forget();
    this.onclose?.();
  }
  /** As the WebSocket of Node up to 22 does when it cannot connect: no close event follows. */
  fail(): void {
    this.forget();
    this.onerror?.();
  }

  private forget(): void {
    this.writer?.far.client.dispose();
    this.reader?.client.dispose();
    this.writer = this.reader = null;
  }

  private faceReader(): Far {
    if (this.reader) return this.reader;
    this.reader = new Far('subscribe');
    this.reader.client.on('keyframe', (keyframe) => this.sent.push(keyframe));
    this.reader.client.on('frames', (frames) => this.sent.push(frames));
    return this.reader;
  }
}

const typeOf = (name: Message['type']): number => messages.find((message) => message.name === name)!.type;
const keyframeType = typeOf('keyframe');
const framesType = typeOf('frames');

/** A client of its own that is connected to nothing but this: it reads what it is given, or writes what it publishes. */
class Far {
  readonly client: StreamClient;
  readonly sent: Uint8Array[] = [];
  private onmessage: ((event: { data: ArrayBuffer }) => void) | null = null;

  constructor(role: 'subscribe' | 'publish') {
    let open: (() => void) | null = null;
    const far = this;
    class Socket {
      bufferedAmount = 0;
      set onopen(call: () => void) {
        open = call;
      }
      set onmessage(call: (event: { data: ArrayBuffer }) => void) {
        far.onmessage = call;
      }
      send(data: Uint8Array): void {
        far.sent.push(data.slice());
      }
      close(): void {}
    }
    this.client = new StreamClient('ws://far', {
      role,
      WebSocket: Socket as unknown as NonNullable<StreamOptions['WebSocket']>,
      now: () => 0,
      pingInterval: 0,
    });
    this.client.on('fault', (fault) => {
      throw fault;
    });
    this.client.connect();
    open!();
    this.give(encodeMessage(headerOf({})));
    this.sent.length = 0;
  }

  give(data: Uint8Array): void {
    this.onmessage!({ data: data.slice().buffer });
  }
}

/** Codes a keyframe and the frames after it. A publisher counts from 0, and this writes the numbers of the messages instead. */
class FaceWriter {
  readonly far = new Far('publish');

  keyframe({ sequence, media_time, state }: Keyframe): Uint8Array {
    const from = new ByteReader(this.publish([{ time: 0, state }], media_time).subarray(1));
    from.varint();
    from.varint();
    const to = new ByteWriter();
    to.u8(keyframeType);
    to.varint(sequence);
    to.varint(media_time);
    to.append(from.take(from.remaining));
    return to.finish();
  }

  frames({ sequence, media_time, frames }: Frames): Uint8Array {
    const bytes = this.publish(frames, media_time);
    bytes[0] = framesType + (sequence % 128);
    return bytes;
  }

  private publish(frames: Frames['frames'], mediaTime: number): Uint8Array {
    this.far.sent.length = 0;
    if (!this.far.client.publish(frames, mediaTime) || this.far.sent.length !== 1) throw new RangeError('cannot be published');
    return this.far.sent[0]!;
  }
}

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
    sound: null,
    ...given,
  };
}

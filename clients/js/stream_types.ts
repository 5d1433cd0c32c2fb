import type { End, Frames, Header, Keyframe, StreamError, StreamRole } from '../../protocol/ts/messages.ts';
import type { ProtocolError } from '../../protocol/ts/protocol_error.ts';

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
  /** A message of the server could not be read, or it does not answer. A new connection follows. */
  fault: ProtocolError;
  clock: ClockSample;
  /** A packet of the sound, if it was asked for. */
  sound: SoundPacket;
  /** A sentence for the client's own voice or for captions, if it was asked for. */
  text: SpokenText;
  /** A message of any kind was received. */
  message: void;
}

/** A packet of the header's codec. Times in ms. */
export interface SoundPacket {
  /** When it begins to be heard, on the clock of the frames. */
  mediaTime: number;
  duration: number;
  packet: Uint8Array<ArrayBuffer>;
}

/** A sentence of a speech. Times in ms. */
export interface SpokenText {
  /** Its number within the epoch. */
  speech: number;
  /** When its first word begins, on the clock of the frames. */
  mediaTime: number;
  /** Of a voice of the client's own: as the server estimates it. */
  duration: number;
  /** BCP 47; empty: unknown. */
  language: string;
  /** Empty: what is being said stops at `mediaTime`, and what waits is not said. */
  text: string;
  /** What the mouth does when: section 2.2 of SPEC.md. */
  score: Uint8Array<ArrayBuffer>;
}

/** One measurement of the server's clock. Times in ms. */
export interface ClockSample {
  roundTrip: number;
  /** Server's wall clock minus the client's clock (`now()`). */
  offset: number;
  /** Media time of the stream when the pong arrived, by the clock estimate. */
  mediaTime: number;
}

/** What a client uses of a WebSocket: browsers' have it, and those of packages for Node. */
export interface ClientSocket {
  binaryType: string;
  readonly bufferedAmount: number;
  onopen: ((event: never) => unknown) | null;
  onclose: ((event: never) => unknown) | null;
  onerror: ((event: never) => unknown) | null;
  onmessage: ((event: never) => unknown) | null;
  send(bytes: Uint8Array<ArrayBuffer>): void;
  close(code?: number): void;
}

export interface StreamOptions {
  role?: StreamRole;
  /** For a publisher: replace the current publisher. Default false. */
  takeOver?: boolean;
  /** For a subscriber: ask for the sound of the stream too; for a publisher: it sends sound (`publishSound`). Default false. */
  sound?: boolean;
  /** For a subscriber with a voice of its own: text in place of the frames and the sound of speech. Default false. */
  text?: boolean;
  /** For a subscriber that shows what is said: text beside the frames and the sound of speech. Default false. */
  captions?: boolean;
  /**
   * For a server that asks for tokens, from a page that is not its own: sent as a subprotocol, because a browser's
   * WebSocket carries no header.
   */
  token?: string;
  /** Default: the platform's WebSocket. Node 18 to 20 have none: pass the class of a package, such as `ws`. */
  WebSocket?: new (url: string, protocols: string[]) => ClientSocket;
  /** ms; default performance.now() */
  now?: () => number;
  /** First and longest pause before a reconnection, ms. Default 250 and 10000; each attempt doubles the pause. */
  backoff?: { first: number; longest: number };
  /**
   * Maximum time between pings, ms; 0: no pings. Default 5000. Shorter after connecting and when round trips jitter.
   */
  pingInterval?: number;
}

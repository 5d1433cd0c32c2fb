// Generated from protocol/schema by semblante-codegen-protocol; change the schema, not this.

import type { FaceFrame, TimedFrame } from '../face_frame.ts';

export const protocolVersion = 1;
export const binarySubprotocol = 'semblante.v1';
export const jsonSubprotocol = 'semblante.v1.json';

export const limits = {
  max_binary_message_bytes: 262144,
  max_json_message_bytes: 1048576,
  max_frames_per_message: 1024,
  max_frame_time: 86400000,
  max_level: 32767,
  max_sound_packet_bytes: 4000,
  max_speech_text_bytes: 2000,
  max_score_bytes: 4000,
} as const;

/** The role of a client in the stream. */
export type StreamRole = 'subscribe' | 'publish';

/** Why a stream or a connection ends. */
export type EndReason = 'other' | 'finished' | 'deleted' | 'shutdown' | 'replaced' | 'slow';

/** How the packets of a sound are coded. */
export type SoundCodec = 'other' | 'opus';

/** What the client's own voice does. */
export type VoiceState = 'reached' | 'ended' | 'failed' | 'ready';

/** The kind of error in a message. */
export type StreamErrorCode = 'other' | 'malformed' | 'truncated' | 'out_of_range' | 'not_finite' | 'too_large' | 'unsupported' | 'mismatch' | 'missing' | 'invalid_argument' | 'not_found' | 'conflict' | 'throttled' | 'unauthorized' | 'internal';

/** The last frame that a client received before it lost its connection. */
export interface ResumePoint {
  /** epoch of the last header */
  epoch: number;
  /** number of the last frame received */
  sequence: number;
}

/** The sound of a stream. */
export interface SoundTrack {
  codec: SoundCodec;
  /** 1/s; samples per second of the decoded sound */
  rate: number;
  channels: number;
  /** bit/s; while somebody speaks; 0: unknown */
  bitrate: number;
}

/** The first message of a client. */
export interface Hello {
  type: 'hello';
  /** highest protocol version the client knows */
  version: number;
  role: StreamRole;
  /** present after a lost connection */
  resume: ResumePoint | null;
  /** for a publisher: replace the current source */
  take_over: boolean;
  /** for a subscriber: send the sound too; for a publisher: it sends sound */
  sound: boolean;
  /** for a subscriber with a voice of its own: send text in place of frames and sound of speech */
  text: boolean;
  /** for a subscriber that shows what is said: send text beside frames and sound of speech */
  captions: boolean;
}

/** The first message of a server: properties of the stream and its encoding. */
export interface Header {
  type: 'header';
  /** protocol version of this connection */
  version: number;
  /** id of the stream */
  stream: string;
  /** for display; may be empty */
  title: string;
  /** id of the suggested model; may be empty */
  model: string;
  /** sequence numbers are only comparable within one epoch */
  epoch: number;
  /** number of the stream's newest frame; 0 before the first */
  sequence: number;
  /** ms; current time of the stream's clock */
  media_time: number;
  /** ms; since 1970-01-01 UTC */
  server_time: number;
  /** 1/s; intended frames per second; 0: unknown */
  fps_hint: number;
  /** ms; intended time between messages; 0: unknown */
  batch_interval: number;
  /** FAP units; steps of FAPs 3 to 68; empty: the standard steps */
  quantizers: number[];
  /** all frames after the resume point follow: none was lost */
  recovered: boolean;
  /** viseme share of Eq. 5, in place of rig.json's; absent: rig.json's */
  viseme_share: number | null;
  /** the sound that may follow; absent: none was asked for, or the server has none */
  sound: SoundTrack | null;
}

/** The complete state at one moment, from which a reader can start. */
export interface Keyframe {
  type: 'keyframe';
  /** number of this frame; 0: before the first */
  sequence: number;
  /** ms */
  media_time: number;
  state: FaceFrame;
}

/** A batch: frame i has the sequence number `sequence` + i and the media time `media_time` + its own time. */
export interface Frames {
  type: 'frames';
  /** number of the first frame; 0 (from a publisher): the next number */
  sequence: number;
  /** ms; 0 (from a publisher): now */
  media_time: number;
  /** 1 to 1024 frames */
  frames: TimedFrame[];
}

/** The last message of a connection. */
export interface End {
  type: 'end';
  reason: EndReason;
}

/** A message was refused; the connection stays open unless it is closed as well. */
export interface StreamError {
  type: 'error';
  code: StreamErrorCode;
  /** JSON pointer to the invalid part of the message, in both subprotocols */
  where: string;
  /** for display */
  message: string;
}

/** One packet of the sound. Nothing is heard between the end of a packet and a later beginning of the next one. */
export interface SoundPacket {
  type: 'sound';
  /** ms; when its first sample is heard, on the clock of the frames */
  media_time: number;
  /** one packet of the header's codec */
  packet: Uint8Array;
}

/** A sentence of a speech, for the client's own voice or for captions. An empty text: what is being said, and what waits, is to stop. */
export interface SpeechText {
  type: 'text';
  /** number of this text within the epoch; increases */
  speech: number;
  /** ms; when its first word is to begin, on the clock of the frames */
  media_time: number;
  /** tag of BCP 47; empty: unknown */
  language: string;
  text: string;
  /** what the mouth does when, as section 2.2 has it */
  score: Uint8Array;
}

/** What the client's own voice does with a text. */
export interface Spoken {
  type: 'spoken';
  state: VoiceState;
  /** number of the text; 0: none */
  speech: number;
  /** number of characters (code points) of the text before the place that is reached */
  character: number;
  /** ms; when it was, on the stream's clock; 0: unknown */
  media_time: number;
}

/** Changes the wish of the hello: whether text comes beside frames and sound of speech. */
export interface CaptionsWish {
  type: 'captions';
  on: boolean;
}

/** Requests the clocks of server and stream. */
export interface Ping {
  type: 'ping';
  /** returned in the pong */
  id: number;
  /** ms; the client's own clock, with any origin */
  client_time: number;
}

/** The response to a ping. */
export interface Pong {
  type: 'pong';
  /** id of the ping */
  id: number;
  /** ms; as in the ping */
  client_time: number;
  /** ms; since 1970-01-01 UTC, when the server read the ping */
  server_time: number;
  /** ms; the stream's clock at that moment */
  media_time: number;
}

export type Message = Hello | Header | Keyframe | Frames | End | StreamError | SoundPacket | SpeechText | Spoken | CaptionsWish | Ping | Pong;

/** Texts of an enumeration by value. An open one reads values it does not know as its first. */
export interface EnumValues {
  readonly names: readonly string[];
  readonly open: boolean;
}

/** One field, in the order of the binary form. */
export type Field =
  | { name: string; type: 'uint'; max: number; required: boolean; fallback: number }
  | { name: string; type: 'real'; min: number; max: number; required: boolean; fallback: number }
  | { name: string; type: 'bool'; appended?: true; required: boolean; fallback: boolean }
  | { name: string; type: 'text'; max: number; required: boolean; fallback: string }
  | { name: string; type: 'bytes'; max: number; required: boolean; fallback: Uint8Array }
  | { name: string; type: 'reals'; min: number; max: number; length: number; required: boolean; fallback: number[] }
  | { name: string; type: 'enum'; values: EnumValues; appended?: true; required: boolean; fallback: string }
  | { name: string; type: 'optional'; fields: readonly Field[]; appended?: true; required: boolean; fallback: null }
  | { name: string; type: 'optional_real'; min: number; max: number; appended: true; required: boolean; fallback: null }
  | { name: string; type: 'state' }
  | { name: string; type: 'frames' };

/** A field that was not there at first: where a message has its default, it is left out or the message ends before it. */
export function isAppended(field: Field): field is Field & { fallback: unknown } {
  return 'appended' in field && field.appended === true;
}

/** A message: the first byte of its binary form, `type` of its JSON form, its fields. */
export interface MessageDescription {
  readonly type: number;
  readonly name: Message['type'];
  readonly fields: readonly Field[];
}

const stream_role_values: EnumValues = { names: ['subscribe', 'publish'], open: false };
const end_reason_values: EnumValues = { names: ['other', 'finished', 'deleted', 'shutdown', 'replaced', 'slow'], open: true };
const sound_codec_values: EnumValues = { names: ['other', 'opus'], open: true };
const voice_state_values: EnumValues = { names: ['reached', 'ended', 'failed', 'ready'], open: false };
const stream_error_code_values: EnumValues = { names: ['other', 'malformed', 'truncated', 'out_of_range', 'not_finite', 'too_large', 'unsupported', 'mismatch', 'missing', 'invalid_argument', 'not_found', 'conflict', 'throttled', 'unauthorized', 'internal'], open: true };

const resume_point_fields: readonly Field[] = [
  { name: 'epoch', type: 'uint', max: 9007199254740991, required: true, fallback: 0 },
  { name: 'sequence', type: 'uint', max: 9007199254740991, required: true, fallback: 0 },
];
const sound_track_fields: readonly Field[] = [
  { name: 'codec', type: 'enum', values: sound_codec_values, required: false, fallback: 'other' },
  { name: 'rate', type: 'uint', max: 192000, required: false, fallback: 0 },
  { name: 'channels', type: 'uint', max: 2, required: false, fallback: 0 },
  { name: 'bitrate', type: 'uint', max: 4294967295, required: false, fallback: 0 },
];

export const messages: readonly MessageDescription[] = [
  {
    type: 1,
    name: 'hello',
    fields: [
      { name: 'version', type: 'uint', max: 65535, required: true, fallback: 1 },
      { name: 'role', type: 'enum', values: stream_role_values, required: false, fallback: 'subscribe' },
      { name: 'resume', type: 'optional', fields: resume_point_fields, required: false, fallback: null },
      { name: 'take_over', type: 'bool', appended: true, required: false, fallback: false },
      { name: 'sound', type: 'bool', appended: true, required: false, fallback: false },
      { name: 'text', type: 'bool', appended: true, required: false, fallback: false },
      { name: 'captions', type: 'bool', appended: true, required: false, fallback: false },
    ],
  },
  {
    type: 2,
    name: 'header',
    fields: [
      { name: 'version', type: 'uint', max: 65535, required: true, fallback: 1 },
      { name: 'stream', type: 'text', max: 256, required: true, fallback: '' },
      { name: 'title', type: 'text', max: 1024, required: false, fallback: '' },
      { name: 'model', type: 'text', max: 256, required: false, fallback: '' },
      { name: 'epoch', type: 'uint', max: 9007199254740991, required: true, fallback: 0 },
      { name: 'sequence', type: 'uint', max: 9007199254740991, required: true, fallback: 0 },
      { name: 'media_time', type: 'uint', max: 9007199254740991, required: true, fallback: 0 },
      { name: 'server_time', type: 'real', min: -1.7976931348623157e308, max: 1.7976931348623157e308, required: false, fallback: 0 },
      { name: 'fps_hint', type: 'real', min: 0, max: 1000, required: false, fallback: 0 },
      { name: 'batch_interval', type: 'uint', max: 60000, required: false, fallback: 0 },
      { name: 'quantizers', type: 'reals', min: 1e-06, max: 1000000.0, length: 66, required: false, fallback: [] },
      { name: 'recovered', type: 'bool', required: false, fallback: false },
      { name: 'viseme_share', type: 'optional_real', min: 0, max: 1, appended: true, required: false, fallback: null },
      { name: 'sound', type: 'optional', fields: sound_track_fields, appended: true, required: false, fallback: null },
    ],
  },
  {
    type: 9,
    name: 'keyframe',
    fields: [
      { name: 'sequence', type: 'uint', max: 9007199254740991, required: false, fallback: 0 },
      { name: 'media_time', type: 'uint', max: 9007199254740991, required: false, fallback: 0 },
      { name: 'state', type: 'state' },
    ],
  },
  {
    type: 128,
    name: 'frames',
    fields: [
      { name: 'sequence', type: 'uint', max: 9007199254740991, required: false, fallback: 0 },
      { name: 'media_time', type: 'uint', max: 9007199254740991, required: false, fallback: 0 },
      { name: 'frames', type: 'frames' },
    ],
  },
  {
    type: 5,
    name: 'end',
    fields: [
      { name: 'reason', type: 'enum', values: end_reason_values, required: false, fallback: 'other' },
    ],
  },
  {
    type: 6,
    name: 'error',
    fields: [
      { name: 'code', type: 'enum', values: stream_error_code_values, required: false, fallback: 'other' },
      { name: 'where', type: 'text', max: 1024, required: false, fallback: '' },
      { name: 'message', type: 'text', max: 4096, required: false, fallback: '' },
    ],
  },
  {
    type: 10,
    name: 'sound',
    fields: [
      { name: 'media_time', type: 'uint', max: 9007199254740991, required: false, fallback: 0 },
      { name: 'packet', type: 'bytes', max: 4000, required: true, fallback: new Uint8Array() },
    ],
  },
  {
    type: 11,
    name: 'text',
    fields: [
      { name: 'speech', type: 'uint', max: 9007199254740991, required: true, fallback: 0 },
      { name: 'media_time', type: 'uint', max: 9007199254740991, required: false, fallback: 0 },
      { name: 'language', type: 'text', max: 64, required: false, fallback: '' },
      { name: 'text', type: 'text', max: 2000, required: false, fallback: '' },
      { name: 'score', type: 'bytes', max: 4000, required: true, fallback: new Uint8Array() },
    ],
  },
  {
    type: 12,
    name: 'spoken',
    fields: [
      { name: 'state', type: 'enum', values: voice_state_values, required: true, fallback: 'reached' },
      { name: 'speech', type: 'uint', max: 9007199254740991, required: false, fallback: 0 },
      { name: 'character', type: 'uint', max: 2000, required: false, fallback: 0 },
      { name: 'media_time', type: 'uint', max: 9007199254740991, required: false, fallback: 0 },
    ],
  },
  {
    type: 14,
    name: 'captions',
    fields: [
      { name: 'on', type: 'bool', required: true, fallback: false },
    ],
  },
  {
    type: 7,
    name: 'ping',
    fields: [
      { name: 'id', type: 'uint', max: 4294967295, required: false, fallback: 0 },
      { name: 'client_time', type: 'real', min: -1.7976931348623157e308, max: 1.7976931348623157e308, required: false, fallback: 0 },
    ],
  },
  {
    type: 8,
    name: 'pong',
    fields: [
      { name: 'id', type: 'uint', max: 4294967295, required: false, fallback: 0 },
      { name: 'client_time', type: 'real', min: -1.7976931348623157e308, max: 1.7976931348623157e308, required: false, fallback: 0 },
      { name: 'server_time', type: 'real', min: -1.7976931348623157e308, max: 1.7976931348623157e308, required: false, fallback: 0 },
      { name: 'media_time', type: 'uint', max: 9007199254740991, required: false, fallback: 0 },
    ],
  },
];

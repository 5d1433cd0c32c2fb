// Generated from protocol/schema by semblante-codegen-protocol; change the schema, not this.

import type { FaceFrame, TimedFrame } from '../face_frame.ts';

export const protocolVersion = 1;
export const binarySubprotocol = 'semblante.v1';
export const jsonSubprotocol = 'semblante.v1.json';

export const packedKeyframeType = 9;
export const packedFramesType = 128;

export const limits = {
  max_binary_message_bytes: 262144,
  max_json_message_bytes: 1048576,
  max_frames_per_message: 1024,
  max_frame_time: 86400000,
  max_level: 32767,
} as const;

/** What a client wants of the stream. */
export type StreamRole = 'subscribe' | 'publish';

/** The form of keyframes and frames on a binary connection. */
export type StreamCoding = 'plain' | 'packed';

/** Why a stream or a connection ends. */
export type EndReason = 'other' | 'finished' | 'deleted' | 'shutdown' | 'replaced' | 'slow';

/** What was wrong with a message. */
export type StreamErrorCode = 'other' | 'malformed' | 'truncated' | 'out_of_range' | 'not_finite' | 'too_large' | 'unsupported' | 'mismatch' | 'missing' | 'invalid_argument' | 'not_found' | 'conflict' | 'throttled' | 'unauthorized' | 'internal';

/** Where a client that lost its connection stopped. */
export interface ResumePoint {
  /** of the header it had */
  epoch: number;
  /** of the last frame it has */
  sequence: number;
}

/** The first message of a client. */
export interface Hello {
  type: 'hello';
  /** highest protocol version the client knows */
  version: number;
  role: StreamRole;
  /** given after a lost connection */
  resume: ResumePoint | null;
  /** the best form the client reads; on a JSON connection of no meaning */
  coding: StreamCoding;
  /** of a publisher: to replace the one there is */
  take_over: boolean;
}

/** The first message of a server: what the stream is and how to read it. */
export interface Header {
  type: 'header';
  /** protocol version of everything that follows */
  version: number;
  /** id of the stream */
  stream: string;
  /** for people; may be empty */
  title: string;
  /** id of the model the stream suggests; may be empty */
  model: string;
  /** sequence numbers are comparable within one epoch only */
  epoch: number;
  /** of the newest frame the stream has had; 0 before the first */
  sequence: number;
  /** ms; of the stream's clock now */
  media_time: number;
  /** ms; since 1970-01-01 UTC */
  server_time: number;
  /** 1/s; frames a second the stream means to have; 0: unknown */
  fps_hint: number;
  /** ms; between messages the server means to send; 0: unknown */
  batch_interval: number;
  /** FAP units; steps of FAPs 3 to 68; empty: the standard steps */
  quantizers: number[];
  /** everything after the resume point follows: nothing was lost */
  recovered: boolean;
  /** of Eq. 5, in place of rig.json's; absent: rig.json's */
  viseme_share: number | null;
  /** the form in which the server sends on this connection */
  coding: StreamCoding;
}

/** The whole state at one moment: a reader can start here. */
export interface Keyframe {
  type: 'keyframe';
  /** of the frame this is; 0: before the first */
  sequence: number;
  /** ms */
  media_time: number;
  /** as differences to the neutral face */
  state: FaceFrame;
}

/** A batch: frame i has the sequence number `sequence` + i and happens at `media_time` + its own time. */
export interface Frames {
  type: 'frames';
  /** of the first frame; 0 (from a publisher): the next */
  sequence: number;
  /** ms; 0 (from a publisher): now */
  media_time: number;
  /** 1 to 1024, each as differences to the one before */
  frames: TimedFrame[];
}

/** Nothing more comes. */
export interface End {
  type: 'end';
  reason: EndReason;
}

/** A message was refused; the connection goes on unless it is closed as well. */
export interface StreamError {
  type: 'error';
  code: StreamErrorCode;
  /** JSON pointer to what is wrong in the message, in both subprotocols */
  where: string;
  /** for people */
  message: string;
}

/** Asks for the clocks of server and stream. */
export interface Ping {
  type: 'ping';
  /** comes back in the pong */
  id: number;
  /** ms; of the client's own clock, of any origin */
  client_time: number;
}

/** The answer to a ping. */
export interface Pong {
  type: 'pong';
  /** of the ping */
  id: number;
  /** ms; as it came in the ping */
  client_time: number;
  /** ms; since 1970-01-01 UTC, when the ping was read */
  server_time: number;
  /** ms; of the stream's clock at that moment */
  media_time: number;
}

export type Message = Hello | Header | Keyframe | Frames | End | StreamError | Ping | Pong;

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
  | { name: string; type: 'reals'; min: number; max: number; length: number; required: boolean; fallback: number[] }
  | { name: string; type: 'enum'; values: EnumValues; appended?: true; required: boolean; fallback: string }
  | { name: string; type: 'optional'; fields: readonly Field[]; required: boolean; fallback: null }
  | { name: string; type: 'optional_real'; min: number; max: number; required: boolean; fallback: null }
  | { name: string; type: 'state' }
  | { name: string; type: 'frames' };

/** A field that was not there at first: where a message has its default, it is left out or the message ends before it. */
export function isAppended(field: Field): field is Field & { fallback: unknown } {
  return field.type === 'optional_real' || ((field.type === 'bool' || field.type === 'enum') && field.appended === true);
}

/** A message: the first byte of its binary form, `type` of its JSON form, its fields. */
export interface MessageDescription {
  readonly type: number;
  readonly name: Message['type'];
  readonly fields: readonly Field[];
}

const stream_role_values: EnumValues = { names: ['subscribe', 'publish'], open: false };
const stream_coding_values: EnumValues = { names: ['plain', 'packed'], open: true };
const end_reason_values: EnumValues = { names: ['other', 'finished', 'deleted', 'shutdown', 'replaced', 'slow'], open: true };
const stream_error_code_values: EnumValues = { names: ['other', 'malformed', 'truncated', 'out_of_range', 'not_finite', 'too_large', 'unsupported', 'mismatch', 'missing', 'invalid_argument', 'not_found', 'conflict', 'throttled', 'unauthorized', 'internal'], open: true };

const resume_point_fields: readonly Field[] = [
  { name: 'epoch', type: 'uint', max: 9007199254740991, required: true, fallback: 0 },
  { name: 'sequence', type: 'uint', max: 9007199254740991, required: true, fallback: 0 },
];

export const messages: readonly MessageDescription[] = [
  {
    type: 1,
    name: 'hello',
    fields: [
      { name: 'version', type: 'uint', max: 65535, required: true, fallback: 1 },
      { name: 'role', type: 'enum', values: stream_role_values, required: false, fallback: 'subscribe' },
      { name: 'resume', type: 'optional', fields: resume_point_fields, required: false, fallback: null },
      { name: 'coding', type: 'enum', values: stream_coding_values, appended: true, required: false, fallback: 'plain' },
      { name: 'take_over', type: 'bool', appended: true, required: false, fallback: false },
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
      { name: 'server_time', type: 'real', min: -Number.MAX_VALUE, max: Number.MAX_VALUE, required: false, fallback: 0 },
      { name: 'fps_hint', type: 'real', min: 0, max: 1000, required: false, fallback: 0 },
      { name: 'batch_interval', type: 'uint', max: 60000, required: false, fallback: 0 },
      { name: 'quantizers', type: 'reals', min: 1e-06, max: 1000000.0, length: 66, required: false, fallback: [] },
      { name: 'recovered', type: 'bool', required: false, fallback: false },
      { name: 'viseme_share', type: 'optional_real', min: 0, max: 1, required: false, fallback: null },
      { name: 'coding', type: 'enum', values: stream_coding_values, appended: true, required: false, fallback: 'plain' },
    ],
  },
  {
    type: 3,
    name: 'keyframe',
    fields: [
      { name: 'sequence', type: 'uint', max: 9007199254740991, required: false, fallback: 0 },
      { name: 'media_time', type: 'uint', max: 9007199254740991, required: false, fallback: 0 },
      { name: 'state', type: 'state' },
    ],
  },
  {
    type: 4,
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
    type: 7,
    name: 'ping',
    fields: [
      { name: 'id', type: 'uint', max: 4294967295, required: false, fallback: 0 },
      { name: 'client_time', type: 'real', min: -Number.MAX_VALUE, max: Number.MAX_VALUE, required: false, fallback: 0 },
    ],
  },
  {
    type: 8,
    name: 'pong',
    fields: [
      { name: 'id', type: 'uint', max: 4294967295, required: false, fallback: 0 },
      { name: 'client_time', type: 'real', min: -Number.MAX_VALUE, max: Number.MAX_VALUE, required: false, fallback: 0 },
      { name: 'server_time', type: 'real', min: -Number.MAX_VALUE, max: Number.MAX_VALUE, required: false, fallback: 0 },
      { name: 'media_time', type: 'uint', max: 9007199254740991, required: false, fallback: 0 },
    ],
  },
];

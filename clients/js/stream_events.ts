import { neutralFrame, type TimedFrame } from '../../protocol/ts/face_frame.ts';
import { protocolVersion, type End, type EndReason, type Header, type SoundCodec, type StreamError, type StreamErrorCode } from '../../protocol/ts/messages.ts';
import { ProtocolError } from '../../protocol/ts/protocol_error.ts';
import { standardQuantizers, type QuantizerSteps } from '../../protocol/ts/quantizers.ts';
import { readFrame } from './frames.ts';
import { errorLayout, eventLayout, headerLayout, timedFrameLayout } from './generated/layouts.ts';
import type { StreamMemory } from './stream_memory.ts';
import type { ClockSample, ConnectionState, SoundPacket, SpokenText } from './stream_types.ts';

// What the library tells of a stream, out of its memory. The enumerations are those of semblante.h, in order.
export const eventType = { state: 1, connect: 2, close: 3, header: 4, keyframe: 5, frames: 6, clock: 7, refused: 8, fault: 9, end: 10, sound: 11, text: 12 } as const;
const states: readonly ConnectionState[] = ['closed', 'connecting', 'open', 'waiting'];
const endReasons: readonly EndReason[] = ['other', 'finished', 'deleted', 'shutdown', 'replaced', 'slow'];
const soundCodecs: readonly SoundCodec[] = ['other', 'opus'];
const refusals: readonly StreamErrorCode[] = [
  'other',
  'malformed',
  'truncated',
  'out_of_range',
  'not_finite',
  'too_large',
  'unsupported',
  'mismatch',
  'missing',
  'invalid_argument',
  'not_found',
  'conflict',
  'throttled',
  'unauthorized',
  'internal',
];
/** semblante_result as the nearest code of the protocol */
const faults: readonly StreamErrorCode[] = [
  'other',
  'invalid_argument',
  'malformed',
  'unsupported',
  'mismatch',
  'too_large',
  'too_large',
  'internal',
  'internal',
  'other',
];
const resumed = 1;

const count = ({ runtime, event }: StreamMemory, member: number): number => runtime.view.getUint32(event + member, true);
const real = ({ runtime, event }: StreamMemory, member: number): number => runtime.view.getFloat64(event + member, true);

export const readType = (memory: StreamMemory): number => count(memory, eventLayout.type);
export const readState = (memory: StreamMemory): ConnectionState => states[count(memory, eventLayout.state)]!;
/** With which a connection is closed. */
export const readCloseCode = (memory: StreamMemory): number => count(memory, eventLayout.code);

export function readClock(memory: StreamMemory): ClockSample {
  return {
    roundTrip: real(memory, eventLayout.round_trip),
    offset: real(memory, eventLayout.server_offset),
    mediaTime: real(memory, eventLayout.media_time),
  };
}

export function readEnd(memory: StreamMemory): End {
  return { type: 'end', reason: endReasons[count(memory, eventLayout.code)] ?? 'other' };
}

function readError({ runtime, event }: StreamMemory): { where: string; message: string } {
  const at = event + eventLayout.error;
  return { where: runtime.text(at + errorLayout.where), message: runtime.text(at + errorLayout.message) };
}

export function readRefusal(memory: StreamMemory): StreamError {
  return { type: 'error', code: refusals[count(memory, eventLayout.code)] ?? 'other', ...readError(memory) };
}

export function readFault(memory: StreamMemory): ProtocolError {
  const { where, message } = readError(memory);
  return new ProtocolError(faults[count(memory, eventLayout.code)] ?? 'other', where, message);
}

function readPacket(memory: StreamMemory): Uint8Array<ArrayBuffer> {
  const at = count(memory, eventLayout.packet);
  return memory.runtime.bytes.slice(at, at + count(memory, eventLayout.packet_size)) as Uint8Array<ArrayBuffer>;
}

export function readSound(memory: StreamMemory): SoundPacket {
  return { mediaTime: real(memory, eventLayout.media_time), duration: real(memory, eventLayout.duration), packet: readPacket(memory) };
}

export function readText(memory: StreamMemory): SpokenText {
  const { runtime, event } = memory;
  return {
    speech: runtime.wide(event + eventLayout.sequence),
    mediaTime: real(memory, eventLayout.media_time),
    duration: real(memory, eventLayout.duration),
    language: runtime.text(count(memory, eventLayout.language)),
    text: runtime.text(count(memory, eventLayout.text)),
    score: readPacket(memory),
  };
}

/** With the FAP units per level of the frames that follow; null: there is none. */
export function readHeader({ runtime, stream, header }: StreamMemory): { header: Header; steps: QuantizerSteps } | null {
  if (runtime.functions.semblante_stream_header(stream, header) !== 0) return null;
  const { view } = runtime;
  const of = headerLayout;
  const real = (member: number): number => view.getFloat64(header + member, true);
  const count = (member: number): number => view.getUint32(header + member, true);
  const text = (member: number): string => runtime.text(count(member));
  const share = real(of.viseme_share);
  const quantizer = count(of.quantizer);
  const steps = standardQuantizers.map((_, fap) => (fap < 3 ? 1 : view.getFloat64(quantizer + fap * 8, true)));
  const sound = {
    codec: soundCodecs[count(of.sound_codec)] ?? 'other',
    rate: count(of.sound_rate),
    channels: count(of.sound_channels),
    bitrate: count(of.sound_bitrate),
  };
  return {
    steps,
    header: {
      type: 'header',
      version: protocolVersion,
      stream: text(of.stream),
      title: text(of.title),
      model: text(of.model),
      epoch: runtime.wide(header + of.epoch),
      sequence: runtime.wide(header + of.sequence),
      media_time: real(of.media_time),
      server_time: real(of.server_time),
      fps_hint: real(of.frame_rate),
      batch_interval: real(of.batch_interval),
      quantizers: Array.from(steps.subarray(3)),
      recovered: count(of.resumed) === resumed,
      viseme_share: Number.isNaN(share) ? null : share,
      sound: sound.rate === 0 ? null : sound,
    },
  };
}

/** The frames of the message that has just arrived, with times relative to the first; null: there are none. */
export function readFrames(
  { runtime, stream, event, result }: StreamMemory,
  steps: QuantizerSteps,
): { sequence: number; media_time: number; frames: TimedFrame[] } | null {
  const sequence = runtime.wide(event + eventLayout.sequence);
  const at = runtime.functions.semblante_stream_frames(stream, result);
  const { view } = runtime;
  const length = view.getUint32(result, true);
  if (length === 0) return null;
  const mediaTime = view.getFloat64(at, true);
  const frames = Array.from({ length }, (_, i) => {
    const frame = at + i * timedFrameLayout.bytes;
    const state = readFrame(view, frame + timedFrameLayout.frame, neutralFrame(), steps);
    return { time: view.getFloat64(frame, true) - mediaTime, state };
  });
  return { sequence, media_time: mediaTime, frames };
}

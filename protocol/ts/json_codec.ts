import {
  firstLowLevelFap,
  lastLowLevelFap,
  maxBlend,
  maxExpression,
  maxViseme,
  neutralFrame,
  type FaceFrame,
  type TimedFrame,
} from './face_frame.ts';
import { isAppended, limits, messages, type Field, type Message } from './generated/messages.ts';
import { opusPacketMs } from './opus_packet.ts';
import { parseJsonObject, type JsonCursor } from './json_cursor.ts';
import { isScoreOf } from './speech_score.ts';
import { quantize, standardQuantizers, type QuantizerSteps } from './quantizers.ts';

type Values = Record<string, unknown>;

/** A frame in JSON: FAPs in FAP units. */
export interface JsonFrame {
  viseme: FaceFrame['viseme'];
  expression: FaceFrame['expression'];
  faps: Record<string, number>;
}

export function frameToJson(state: FaceFrame, steps: QuantizerSteps = standardQuantizers): JsonFrame {
  const faps: Record<string, number> = {};
  for (let fap = firstLowLevelFap; fap <= lastLowLevelFap; ++fap) {
    const level = state.levels[fap]!;
    if (level !== 0) faps[fap] = level * steps[fap]!;
  }
  return { viseme: { ...state.viseme }, expression: { ...state.expression }, faps };
}

/** Encodes one message as text. Frames are complete states (JSON has no delta form). */
export function encodeJson(message: Message, steps: QuantizerSteps = standardQuantizers): string {
  const description = messages.find((candidate) => candidate.name === message.type);
  if (!description) throw new RangeError(`no message has the type ${message.type}`);
  const values: Values = { type: message.type };
  for (const field of description.fields) {
    const value = (message as unknown as Values)[field.name];
    if (field.type === 'optional' && value === null) continue;
    if (isAppended(field) && value === field.fallback) continue;
    if (field.type === 'state') {
      values[field.name] = frameToJson(value as FaceFrame, steps);
    } else if (field.type === 'bytes') {
      values[field.name] = toBase64(value as Uint8Array);
    } else if (field.type === 'frames') {
      values[field.name] = (value as TimedFrame[]).map(({ time, state }) => ({ time, ...frameToJson(state, steps) }));
    } else {
      values[field.name] = value;
    }
  }
  return JSON.stringify(values);
}

/**
 * Decodes one message as a server writes it: the members `arkit` and `oculus` of a frame are for servers to read. Throws ProtocolError with the
 * JSON pointer of the invalid member in `where`.
 */
export function decodeJson(text: string, steps: QuantizerSteps = standardQuantizers): Message {
  const root = parseJsonObject(text, limits.max_json_message_bytes);
  const type = root.member('type');
  const name = type.text(64);
  const description = messages.find((candidate) => candidate.name === name);
  if (!description) return type.fail('unsupported', `no message has the type "${name}"`);
  const values: Values = { type: name };
  for (const field of description.fields) values[field.name] = readField(root, field, steps);
  if (name === 'sound' && opusPacketMs(values.packet as Uint8Array) === null) {
    root.member('packet').fail('malformed', 'is no Opus packet');
  }
  if (name === 'text' && !isScoreOf(values.score as Uint8Array, values.text as string)) {
    root.member('score').fail('malformed', 'is no score of the text');
  }
  return values as unknown as Message;
}

function readField(from: JsonCursor, field: Field, steps: QuantizerSteps): unknown {
  if (field.type === 'state') return readFrame(from.member(field.name), steps);
  if (field.type === 'frames') return readFrames(from.member(field.name), steps);
  const at = field.required ? from.member(field.name) : from.optional(field.name);
  if (at === undefined) return Array.isArray(field.fallback) ? [] : field.fallback;
  switch (field.type) {
    case 'uint':
      return at.integer(0, field.max);
    case 'real':
      return at.number(field.min, field.max);
    case 'bool':
      return at.boolean();
    case 'text':
      return at.text(field.max);
    case 'bytes':
      return readBytes(at, field.max);
    case 'reals': {
      const elements = at.elements(0, field.length);
      if (elements.length !== 0 && elements.length !== field.length) {
        at.fail('out_of_range', `must have 0 or ${field.length} elements`);
      }
      return elements.map((element) => element.number(field.min, field.max));
    }
    case 'enum': {
      const name = at.text(64);
      if (field.values.names.includes(name)) return name;
      return field.values.open
        ? field.values.names[0]
        : at.fail('invalid_argument', `"${name}" is not one of the known values`);
    }
    case 'optional': {
      if (at.isNull) return null;
      const values: Values = {};
      for (const inner of field.fields) values[inner.name] = readField(at, inner, steps);
      return values;
    }
    case 'optional_real':
      return at.isNull ? null : at.number(field.min, field.max);
  }
}

/** Longer texts than the runtime's stack takes as arguments do not occur: `max` of a field is some thousands. */
function toBase64(bytes: Uint8Array): string {
  return btoa(String.fromCharCode(...bytes));
}

function readBytes(at: JsonCursor, max: number): Uint8Array {
  const text = at.text(Math.ceil(max / 3) * 4);
  // atob() takes blanks and texts without padding, which no writer makes.
  if (!/^(?:[A-Za-z0-9+/]{4})*(?:[A-Za-z0-9+/]{2}==|[A-Za-z0-9+/]{3}=)?$/.test(text)) at.fail('malformed', 'must be base64');
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  if (bytes.length > max) at.fail('too_large', `must not exceed ${max} bytes`);
  return bytes;
}

function readFrames(at: JsonCursor, steps: QuantizerSteps): TimedFrame[] {
  let time = 0;
  return at.elements(1, limits.max_frames_per_message).map((element) => {
    const given = element.optional('time');
    const read = given?.integer(0, limits.max_frame_time) ?? time;
    if (read < time) given?.fail('out_of_range', 'times must not decrease');
    time = read;
    return { time, state: readFrame(element, steps) };
  });
}

function readFrame(at: JsonCursor, steps: QuantizerSteps): FaceFrame {
  const state = neutralFrame();
  const viseme = at.optional('viseme');
  if (viseme) {
    state.viseme.select1 = viseme.member('select1').integer(0, maxViseme);
    state.viseme.select2 = viseme.optional('select2')?.integer(0, maxViseme) ?? 0;
    state.viseme.blend = viseme.optional('blend')?.integer(0, maxBlend) ?? maxBlend;
  }
  const expression = at.optional('expression');
  if (expression) {
    state.expression.select1 = expression.member('select1').integer(0, maxExpression);
    state.expression.intensity1 = expression.optional('intensity1')?.integer(0, maxBlend) ?? maxBlend;
    state.expression.select2 = expression.optional('select2')?.integer(0, maxExpression) ?? 0;
    state.expression.intensity2 = expression.optional('intensity2')?.integer(0, maxBlend) ?? 0;
  }
  for (const [name, value] of at.optional('faps')?.members() ?? []) {
    const fap = /^[1-9][0-9]?$/.test(name) ? Number(name) : 0;
    if (fap < firstLowLevelFap || fap > lastLowLevelFap) {
      value.fail('out_of_range', 'low-level FAPs are 3 to 68; 1 and 2 are `viseme` and `expression`');
    }
    const level = quantize(value.number(), steps[fap]!);
    state.levels[fap] = level ?? value.fail('out_of_range', `beyond 32767 levels of ${steps[fap]} FAP units`);
  }
  return state;
}

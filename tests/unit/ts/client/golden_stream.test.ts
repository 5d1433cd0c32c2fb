import { readFileSync } from 'node:fs';
import { beforeAll, beforeEach, describe, expect, it, vi } from 'vitest';
import { Player, StreamClient, type PoseMaker, type StreamOptions } from '../../../../clients/js/index.ts';
import { decodeJson, neutralFrame as neutral, quantizersOf, standardQuantizers, type Message, type QuantizerSteps } from '../../../../protocol/ts/index.ts';
import { messages } from '../../../../protocol/ts/generated/messages.ts';
import { fromHex, vectorJson } from '../protocol/vectors.ts';
import { FakeSocket, headerOf } from '../support/fake_socket.ts';
import { loadRuntime } from '../support/runtime.ts';

// StreamClient decodes the golden files of protocol/vectors by libsemblante in WebAssembly.

beforeAll(loadRuntime);
beforeEach(() => {
  vi.useFakeTimers();
  return () => vi.useRealTimers();
});

interface Vector {
  name: string;
  binary: string;
  json: Record<string, unknown>;
}
const golden = (vectorJson('messages.json') as { messages: Vector[] }).messages;
const appended = (vectorJson('appended_fields.json') as { messages: Vector[] }).messages;
const { streams } = vectorJson('packed.json') as { streams: { name: string; messages: Vector[] }[] };
const refusedPacked = (vectorJson('packed_refused.json') as { refused: { name: string; before: string[]; binary: string; code: string; where: string }[] }).refused;
const refusedPlain = (vectorJson('refused.json') as { refused: { name: string; binary?: string; code: string; where: string }[] }).refused;

interface Connected {
  client: StreamClient;
  socket: FakeSocket;
  events: [string, unknown][];
}

function connected(): Connected {
  const client = new StreamClient('ws://x', {
    WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>,
    now: () => 0,
    pingInterval: 0,
  });
  const events: [string, unknown][] = [];
  for (const name of ['header', 'keyframe', 'frames', 'end', 'error', 'fault'] as const) client.on(name, (event) => events.push([name, event]));
  client.connect();
  FakeSocket.last.accept();
  return { client, socket: FakeSocket.last, events };
}

const give = (socket: FakeSocket, hex: string): void => socket.giveRaw(fromHex(hex).slice().buffer);

/** The message of the file as the client reports it: times from the first frame, the steps written out. */
function reported(message: Message): Message {
  if (message.type === 'frames') {
    const first = message.frames[0]!.time;
    const frames = message.frames.map(({ time, state }) => ({ time: time - first, state }));
    return { ...message, media_time: message.media_time + first, frames };
  }
  if (message.type === 'header') return { ...message, quantizers: Array.from(quantizersOf(message).subarray(3)) };
  return message;
}

/** The library's results are coarser than the codes of the files. */
const resultOf = (code: string): string => (['unsupported', 'mismatch', 'too_large'].includes(code) ? code : 'malformed');

const ofClients = messages.filter(({ name }) => ['hello', 'ping', 'spoken'].includes(name)).map(({ type }) => type);

describe('golden messages', () => {
  it('Receive_MessagesOfAServer_AreTheJson', () => {
    const { socket, events } = connected();
    let steps: QuantizerSteps = standardQuantizers;
    let seen = 0;
    for (const { name, binary, json } of golden) {
      const meant = decodeJson(JSON.stringify(json), steps);
      if (meant.type === 'hello' || meant.type === 'ping' || meant.type === 'pong' || meant.type === 'end') continue;
      if (meant.type === 'header' && meant.quantizers.length > 0 && !name.includes('standard')) continue; // steps of its own: below
      if ((meant.type === 'keyframe' || meant.type === 'frames') && meant.sequence === 0 && meant.type === 'frames') continue;
      if (meant.type === 'header') steps = quantizersOf(meant);
      events.length = 0;
      give(socket, binary);
      const [found] = events;
      expect(found?.[0], name).toBe(meant.type);
      if (meant.type === 'header') {
        const { recovered, ...rest } = reported(meant) as Message & { recovered: boolean };
        expect(found![1], name).toMatchObject(rest);
        expect(recovered).toBeDefined();
      } else expect(found![1], name).toEqual(reported(meant));
      seen += 1;
    }
    expect(seen).toBeGreaterThan(5);
  });

  it.each(appended.filter(({ json }) => json['type'] === 'header'))('Receive_AppendedFields: $name', ({ binary, json }) => {
    const { socket, client } = connected();
    give(socket, binary);
    expect(client.header?.viseme_share).toBe(json['viseme_share'] ?? null);
  });

  it.each(streams)('Receive_PackedStream_IsTheJson: $name', ({ messages }) => {
    const readers: Connected[] = [];
    for (const { binary, json } of messages) {
      const meant = decodeJson(JSON.stringify(json));
      if (meant.type === 'keyframe') {
        const reader = connected(); // who joins here
        reader.socket.give(headerOf({}));
        readers.push(reader);
      }
      const mine = meant.type === 'keyframe' ? readers.slice(-1) : readers;
      for (const { socket, events } of mine) {
        events.length = 0;
        give(socket, binary);
        expect(events).toEqual([[meant.type, reported(meant)]]);
      }
    }
  });

  it.each(refusedPacked)('Receive_InvalidPacked_Faults: $name', ({ before, binary, code, where }) => {
    const { socket, events } = connected();
    socket.give(headerOf({}));
    for (const each of before) give(socket, each);
    events.length = 0;
    give(socket, binary);
    expect(events).toMatchObject([['fault', { code: resultOf(code), where }]]);
  });

  it.each(refusedPlain.filter(({ binary }) => binary !== undefined))('Receive_InvalidPlain_Faults: $name', ({ binary, code, where }) => {
    const { socket, events } = connected();
    socket.give(headerOf({}));
    give(socket, '03000000');
    events.length = 0;
    give(socket, binary!);
    // What is of a later version, or what only clients send, is skipped.
    if ((code === 'unsupported' && where === '/type') || ofClients.includes(fromHex(binary!)[0]!)) expect(events).toEqual([]);
    else expect(events).toMatchObject([['fault', { code: resultOf(code), where }]]);
  });
});

type TraceEvent = [string, ...number[]];
interface Trace {
  name: string;
  options: { delay?: number; eased?: boolean };
  events: TraceEvent[];
  shown: [number | null, number | null][];
  stats: Record<string, number>;
}
/**
 * Without the trace in which one message spans more than 10 s: FakeSocket has its frames coded by a publisher, which may not
 * send so many seconds together. tests/unit/runtime/playout_trace_test.cpp plays all of them.
 */
const traces = (JSON.parse(readFileSync(new URL('../../../../protocol/vectors/clock/traces.json', import.meta.url), 'utf8')) as Trace[]).filter(
  ({ events }) => events.every(([kind, , first = 0, , last = 0]) => kind !== 'frames' || last - first <= 10_000),
);

class NoPoses implements PoseMaker {
  evaluateAt(): void {}
  interpolate(): void {}
  ease(): void {}
}

describe('golden traces', () => {
  it('Traces_AreAllButOne', () => expect(traces.length).toBe(11));
  it.each(traces)('Play_IsShownAsTheFileSays: $name', (trace) => {
    let now = trace.events[0]![1]!;
    const client = new StreamClient('ws://x', {
      WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>,
      now: () => now,
      pingInterval: 0,
    });
    const { delay, eased } = trace.options;
    const player = new Player(new NoPoses(), {
      now: () => now,
      interpolation: eased ? 'eased' : 'linear',
      ...(delay === undefined ? {} : { delay }),
    });
    player.follow(client);
    client.connect();
    let sequence = 0;
    let newest = -Infinity;
    const shown: [number, number][] = [];
    const state = { type: 'keyframe' as const };
    for (const [kind, at = 0, a = 0, b = 0, c = 0, d = 0, e = 0] of trace.events) {
      now = at;
      if (kind === 'header') {
        FakeSocket.sockets.at(-1)?.drop();
        now = a;
        client.connect();
        FakeSocket.last.accept();
        now = at;
        if (client.header?.epoch !== b) newest = -Infinity;
        FakeSocket.last.give(headerOf({ epoch: b, media_time: c, fps_hint: d, batch_interval: e, sequence }));
        sequence = 0;
      } else if (kind === 'answer') {
        FakeSocket.last.give({ type: 'pong', id: 1, client_time: a, server_time: 0, media_time: b });
      } else if (kind === 'frames') {
        const times = [...new Set([a, b, c])].filter((time) => time > newest);
        newest = c;
        const frames = times.map((time) => ({ time: time - times[0]!, state: neutral() }));
        if (sequence === 0 && times.length === 1) {
          FakeSocket.last.give({ ...state, sequence: (sequence = 1), media_time: times[0]!, state: neutral() });
          continue;
        }
        if (sequence === 0) {
          // A frame at the first one's own time is none to the player.
          FakeSocket.last.give({ ...state, sequence: (sequence = 1), media_time: 0, state: neutral() });
        }
        FakeSocket.last.give({ type: 'frames', sequence: sequence + 1, media_time: times[0]!, frames });
        sequence += frames.length;
      } else {
        player.update(a / 1000);
        shown.push([player.playhead, player.delay]);
      }
    }
    const far = (actual: number, expected: number | null): boolean =>
      expected === null ? !Number.isNaN(actual) : !(Math.abs(actual - expected) < 1e-5);
    expect(shown.length).toBe(trace.shown.length);
    expect(shown.findIndex((pair, i) => pair.some((value, k) => far(value, trace.shown[i]![k]!)))).toBe(-1);
  });
});

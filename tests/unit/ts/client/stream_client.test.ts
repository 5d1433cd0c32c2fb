import { afterEach, beforeAll, beforeEach, describe, expect, it, vi } from 'vitest';
import { StreamClient, streamUrl, type StreamOptions } from '../../../../clients/js/index.ts';
import { neutralFrame, type FaceFrame, type Header, type Message } from '../../../../protocol/ts/index.ts';
import { FakeSocket } from '../support/fake_socket.ts';
import { loadRuntime } from '../support/runtime.ts';

beforeAll(loadRuntime);

const header: Header = {
  type: 'header',
  version: 1,
  stream: 'demo',
  title: '',
  model: '',
  epoch: 9,
  sequence: 41,
  media_time: 1000,
  server_time: 1.7e12,
  fps_hint: 25,
  batch_interval: 40,
  quantizers: [],
  recovered: false,
  viseme_share: null,
    sound: null,
};
const state = (level: number): FaceFrame => {
  const frame = neutralFrame();
  frame.levels[3] = level;
  return frame;
};
const keyframe = (sequence: number): Message => ({ type: 'keyframe', sequence, media_time: 1000, state: state(1) });
const frames = (sequence: number, count = 1): Message => ({
  type: 'frames',
  sequence,
  media_time: 1040,
  frames: Array.from({ length: count }, (_, i) => ({ time: i, state: state(i) })),
});

function client(options: StreamOptions = {}): { stream: StreamClient; events: [string, unknown][] } {
  const stream = new StreamClient('ws://x/v1/streams/demo', {
    WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>,
    ...options,
  });
  const events: [string, unknown][] = [];
  for (const name of ['state', 'header', 'keyframe', 'frames', 'end', 'error', 'fault', 'clock'] as const) {
    stream.on(name, (event) => events.push([name, event]));
  }
  return { stream, events };
}

beforeEach(() => {
  vi.useFakeTimers();
  FakeSocket.sockets = [];
});
afterEach(() => {
  vi.useRealTimers();
});

describe('StreamClient', () => {
  it('Connect_OffersItsSubprotocolAndSaysHello', () => {
    const { stream, events } = client();
    stream.connect();
    FakeSocket.last.accept();
    expect(FakeSocket.last.protocols).toEqual(['semblante.v1']);
    expect(FakeSocket.last.sent).toEqual([
      { type: 'hello', version: 1, role: 'subscribe', resume: null, take_over: false, sound: false, text: false, captions: false },
    ]);
    FakeSocket.last.give(header);
    expect(stream.state).toBe('open');
    expect(events.map(([name]) => name)).toEqual(['state', 'header', 'state']);
  });

  it('Connect_AddressThatIsNone_IsAFaultAndNoAttemptMore', () => {
    const { stream, events } = client({
      WebSocket: class {
        constructor() {
          throw new SyntaxError('the scheme garbage is not allowed');
        }
      } as unknown as NonNullable<StreamOptions['WebSocket']>,
    });
    stream.connect();
    expect(stream.state).toBe('closed');
    const faults = events.filter(([name]) => name === 'fault').map(([, fault]) => (fault as Error).message);
    expect(faults).toEqual(['ws://x/v1/streams/demo: the scheme garbage is not allowed']);
    vi.advanceTimersByTime(60_000);
    expect(events.filter(([name]) => name === 'fault')).toHaveLength(1);
  });

  it('Connect_WithoutAWebSocket_IsAFaultThatNamesTheOption', () => {
    vi.stubGlobal('WebSocket', undefined);
    const stream = new StreamClient('ws://x/v1/streams/demo');
    vi.unstubAllGlobals();
    const faults: string[] = [];
    stream.on('fault', ({ message }) => faults.push(message));
    stream.connect();
    expect(stream.state).toBe('closed');
    expect(faults).toEqual(["ws://x/v1/streams/demo: there is no WebSocket here: give the option WebSocket, as of the package 'ws'"]);
  });

  it('Receive_KeyframeAndFrames_EmitsThem', () => {
    const { stream, events } = client();
    stream.connect();
    FakeSocket.last.accept();
    for (const message of [header, keyframe(41), frames(42, 2)]) FakeSocket.last.give(message);
    expect(events.filter(([name]) => name === 'keyframe' || name === 'frames')).toEqual([
      ['keyframe', keyframe(41)],
      ['frames', frames(42, 2)],
    ]);
  });

  it('Drop_AfterFrames_ComesBackAndResumes', () => {
    const { stream } = client();
    stream.connect();
    FakeSocket.last.accept();
    for (const message of [header, keyframe(41), frames(42, 2)]) FakeSocket.last.give(message);
    FakeSocket.last.drop();
    expect(stream.state).toBe('waiting');
    vi.advanceTimersByTime(250);
    expect(FakeSocket.sockets.length).toBe(2);
    FakeSocket.last.accept();
    expect(FakeSocket.last.sent[0]).toMatchObject({ type: 'hello', resume: { epoch: 9, sequence: 43 } });
    for (const message of [{ ...header, recovered: true }, keyframe(43), frames(44)]) FakeSocket.last.give(message);
    expect(stream.state).toBe('open');
  });

  it('Publish_SendsAWholeStateFirst', () => {
    const { stream } = client({ role: 'publish' });
    expect(stream.publish([{ time: 0, state: state(1) }])).toBe(false);
    stream.connect();
    FakeSocket.last.accept();
    FakeSocket.last.give(header);
    expect(stream.publish([{ time: 0, state: state(1) }], 5)).toBe(true);
    expect(stream.publish([{ time: 0, state: state(2) }], 45)).toBe(true);
    const types = FakeSocket.last.sent.map((message) => message.type).filter((type) => type !== 'ping');
    expect(types).toEqual(['hello', 'keyframe', 'frames']);
    FakeSocket.last.give({ type: 'error', code: 'throttled', where: '', message: '' });
    expect(stream.publish([1, 2, 3].map((i) => ({ time: i, state: state(i) })), 85)).toBe(true);
    expect(FakeSocket.last.sent.slice(-2)).toMatchObject([
      { type: 'keyframe', media_time: 86, state: { levels: state(1).levels } },
      { type: 'frames', media_time: 87, frames: [{ time: 0 }, { time: 1 }] },
    ]);
    FakeSocket.last.bufferedAmount = 1e6;
    expect(stream.publish([{ time: 0, state: state(3) }])).toBe(false);
  });
});

describe('StreamClient', () => {
  it('Drop_AgainAndAgain_WaitsLongerEachTimeUpToALimit', () => {
    const { stream } = client({ backoff: { first: 100, longest: 1000 } });
    stream.connect();
    for (const pause of [100, 200, 400, 800, 1000, 1000]) {
      const before = FakeSocket.sockets.length;
      FakeSocket.last.drop();
      vi.advanceTimersByTime(pause / 2 - 1); // the other half is random
      expect(FakeSocket.sockets.length).toBe(before);
      vi.advanceTimersByTime(pause / 2 + 2);
      expect(FakeSocket.sockets.length).toBe(before + 1);
    }
  });

  it('Connect_ErrorWithoutClose_ComesBackAfterThePause', () => {
    const { stream } = client();
    stream.connect();
    FakeSocket.last.fail();
    expect(stream.state).toBe('waiting');
    vi.advanceTimersByTime(250);
    expect(FakeSocket.sockets.length).toBe(2);
  });

  it('Connect_ErrorThenClose_CountsOnce', () => {
    const { stream } = client({ backoff: { first: 100, longest: 1000 } });
    stream.connect();
    FakeSocket.last.fail();
    FakeSocket.last.drop();
    vi.advanceTimersByTime(102);
    expect(FakeSocket.sockets.length).toBe(2);
    FakeSocket.sockets[0]!.drop(); // late
    expect(stream.state).toBe('connecting');
  });

  it('Receive_UnreadableBytes_FaultsAndStartsAnew', () => {
    const { stream, events } = client();
    stream.connect();
    FakeSocket.last.accept();
    FakeSocket.last.give(header);
    FakeSocket.last.giveRaw(Uint8Array.from([9, 1]).buffer);
    expect(events.at(-2)).toMatchObject(['fault', { code: 'malformed' }]);
    expect(stream.state).toBe('waiting');
  });

  it('Receive_AGapInTheFrames_FaultsAndStartsAnew', () => {
    const { stream, events } = client();
    stream.connect();
    FakeSocket.last.accept();
    FakeSocket.last.give(header);
    FakeSocket.last.give(keyframe(41));
    FakeSocket.last.giveRaw(Uint8Array.from([128 + 50, 0]).buffer);
    expect(events.find(([name]) => name === 'fault')).toMatchObject(['fault', { code: 'mismatch' }]);
    expect(stream.state).toBe('waiting');
  });

  it('Receive_MessageOfALaterVersion_IsSkipped', () => {
    const { stream } = client();
    stream.connect();
    FakeSocket.last.accept();
    FakeSocket.last.give(header);
    FakeSocket.last.giveRaw(Uint8Array.from([77, 1, 2]).buffer);
    expect(stream.state).toBe('open');
  });

  it('Receive_End_ClosesForGoodOnlyWhenTheStreamIsOver', () => {
    const over = client();
    over.stream.connect();
    FakeSocket.last.accept();
    FakeSocket.last.give({ type: 'end', reason: 'deleted' });
    expect(over.stream.state).toBe('closed');
    vi.advanceTimersByTime(60_000);
    expect(FakeSocket.sockets.length).toBe(1);

    const restarted = client();
    restarted.stream.connect();
    FakeSocket.last.accept();
    FakeSocket.last.give({ type: 'end', reason: 'shutdown' });
    FakeSocket.last.drop();
    expect(restarted.stream.state).toBe('waiting');
  });

  it('Close_WhileWaiting_DoesNotComeBack', () => {
    const { stream } = client();
    stream.connect();
    FakeSocket.last.drop();
    stream.close();
    vi.advanceTimersByTime(60_000);
    expect(FakeSocket.sockets.length).toBe(1);
    expect(stream.state).toBe('closed');
  });

  it('Ping_Answered_GivesTheClock', () => {
    let now = 100;
    const { stream, events } = client({ now: () => now });
    stream.connect();
    FakeSocket.last.accept();
    FakeSocket.last.give(header);
    expect(FakeSocket.last.sent.at(-1)).toEqual({ type: 'ping', id: 1, client_time: 100 });
    now = 120;
    FakeSocket.last.give({ type: 'pong', id: 1, client_time: 100, server_time: 5000, media_time: 700 });
    // Half of the 20 ms of the way is the answer's: the server's clock shows 5010 now.
    expect(events.at(-1)).toEqual(['clock', { roundTrip: 20, offset: 5010 - 120, mediaTime: 710 }]);
  });

  it('Ping_AfterTheHeader_ComesQuicklyAtFirst', () => {
    const start = Date.now();
    const { stream } = client({ now: () => Date.now() - start });
    stream.connect();
    FakeSocket.last.accept();
    vi.advanceTimersByTime(20);
    FakeSocket.last.give(header);
    const pings = (): number => FakeSocket.last.sent.filter(({ type }) => type === 'ping').length;
    expect(pings()).toBe(1);
    vi.advanceTimersByTime(800);
    expect(pings()).toBe(5);
    vi.advanceTimersByTime(10_200);
    expect(pings()).toBe(15);
    // Way and way back took 20 ms: that is known within 10.
    expect(stream.streamClock.uncertainty).toBeCloseTo(10.5, 6);
    const { sent } = FakeSocket.last;
    FakeSocket.last.give({ type: 'pong', id: 15, client_time: 12, server_time: 0, media_time: header.media_time + 4 });
    expect(stream.streamClock.uncertainty).toBeLessThan(10);
    vi.advanceTimersByTime(2000); // was set before that
    const before = sent.length;
    vi.advanceTimersByTime(4700);
    expect(sent.length).toBe(before);
    vi.advanceTimersByTime(400);
    expect(sent.length).toBe(before + 1);
    stream.measureClock();
    vi.advanceTimersByTime(800);
    expect(sent.length).toBe(before + 6);
    stream.close();
    vi.advanceTimersByTime(60_000);
    expect(sent.length).toBe(before + 6);
  });

  it('Header_AgainAndOfAnotherEpoch_KeepsOrForgetsTheClock', () => {
    let now = 0;
    const { stream } = client({ now: () => now });
    stream.connect();
    FakeSocket.last.accept();
    now = 100;
    FakeSocket.last.give(header);
    expect(stream.streamClock.at(100)).toBeCloseTo(header.media_time + 50.5, 6);
    FakeSocket.last.drop();
    vi.advanceTimersByTime(700);
    now = 1000;
    FakeSocket.last.accept();
    now = 1010; // the clock said 1000 and a little at 0 to 100, so now 1900 to 2010
    FakeSocket.last.give({ ...header, media_time: 1960 });
    expect(stream.streamClock.at(1010)).toBeCloseTo(1965.5, 6);
    expect(stream.streamClock.steps).toBe(0);
    FakeSocket.last.drop();
    vi.advanceTimersByTime(700);
    now = 2000;
    FakeSocket.last.accept();
    FakeSocket.last.give({ ...header, epoch: 10, media_time: 7 });
    expect(stream.streamClock.at(2000)).toBeCloseTo(7.5, 6);
    expect(stream.streamClock.steps).toBe(0);
  });

  it('StreamUrl_OfHttpAndHttps', () => {
    expect(streamUrl('http://127.0.0.1:8080/', 'a b')).toBe('ws://127.0.0.1:8080/v1/streams/a%20b');
    expect(streamUrl('https://x', 'demo')).toBe('wss://x/v1/streams/demo');
  });
});

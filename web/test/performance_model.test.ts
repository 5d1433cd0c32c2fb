import { describe, expect, test } from 'vitest';
import { ApiError } from '../src/net/problem.ts';
import type { AbsentFap, FapPlaying, Playing, PlayOptions, Problem, StreamInfo } from '../src/net/types.ts';
import { FaceDriver } from '../src/ui/stage/face_driver.ts';
import { PerformanceModel } from '../src/ui/live/performance_model.ts';
import type { Studio } from '../src/ui/shared/studio.ts';
import { FakeLive } from './support/fake_live.ts';
import { neutralFrame } from '@client/index.ts';

const stream = (id: string, more: Partial<StreamInfo> = {}): StreamInfo => ({
  id,
  title: `Stream ${id}`,
  model: null,
  created: '2026-01-01T00:00:00Z',
  epoch: 1,
  sequence: 0,
  subscribers: 0,
  publishers: 0,
  source: 'none',
  active_source: null,
  batch_interval: 100,
  quantizer_scale: 1,
  is_public: false,
  subscribers_by_coding: { packed: 0, json: 0 },
  bytes_sent: 0,
  messages_coalesced: 0,
  lateness_p99: null,
  clamped_values: 0,
  viseme_share: null,
  playing: null,
  failed: null,
  ...more,
});

const playing = (more: Partial<Playing> = {}): Playing => ({
  id: 'p1',
  kind: 'performance',
  name: 'Hello',
  duration: 4000,
  position: 0,
  fps: 25,
  loop: false,
  complete: true,
  failure: null,
  ...more,
});

/** A server with these streams; what was asked of it is written down. */
class FakeServer {
  streams: StreamInfo[] = [];
  readonly asked: { stream: string; options: PlayOptions }[] = [];
  readonly stopped: string[] = [];
  refuse: Problem | null = null;
  readonly faps: string[] = [];
  private made = 0;

  readonly listStreams = (): Promise<StreamInfo[]> => Promise.resolve(structuredClone(this.streams));
  readonly createStream = (title: string): Promise<StreamInfo> => {
    const made = stream('made', { title });
    this.streams.push(made);
    return Promise.resolve(made);
  };
  readonly playPerformance = (id: string, _document: Blob, options: PlayOptions): Promise<Playing> => {
    this.asked.push({ stream: id, options });
    if (this.refuse) return Promise.reject(new ApiError(this.refuse));
    this.made += 1;
    const now = playing({ id: `p${this.made}`, loop: options.loop, position: options.from });
    this.streams = this.streams.map((one) => (one.id === id ? { ...one, playing: now } : one));
    return Promise.resolve(now);
  };
  readonly playFap = async (id: string, file: Blob, options: PlayOptions, absent: AbsentFap): Promise<FapPlaying> => {
    this.faps.push(absent);
    return { ...(await this.playPerformance(id, file, options)), warnings: ['line 2: 69 flags'] };
  };
  readonly stopPlaying = (id: string, what: string): Promise<void> => {
    this.stopped.push(what);
    this.streams = this.streams.map((one) => (one.id === id ? { ...one, playing: null } : one));
    return Promise.resolve();
  };
}

async function setUp(streams: StreamInfo[]) {
  const server = new FakeServer();
  server.streams = streams;
  const studio = {
    api: server,
    selected: { value: { id: 'm', name: 'Ada' } },
    attempt: async (_what: string, action: () => Promise<void>) => {
      await action();
      return true;
    },
  } as unknown as Studio;
  const clock = { now: 1000 };
  const frame = neutralFrame();
  const driver = new FaceDriver(frame);
  const live = new FakeLive(studio, frame, driver);
  const model = new PerformanceModel(studio, live, () => clock.now);
  await live.refresh();
  model.choose({ kind: 'performance', title: 'hello.json', text: '{"cues": [\n{"viseme": "q"}]}' });
  return { server, live, model, clock };
}

describe('performance model', () => {
  test('Play_NoOwnStream_MakesOneAndFollowsIt', async () => {
    const { server, live, model } = await setUp([stream('demo', { source: 'demo' })]);
    await model.play();
    expect(server.asked).toEqual([{ stream: 'made', options: { loop: false, from: 0, take_over: false } }]);
    expect(server.streams.at(-1)?.title).toBe('Ada, performing');
    expect(live.following.value).toBe('made');
    expect(live.driver.source.value).toBe('stream');
    expect(model.playing.value?.name).toBe('Hello');
  });

  test('Play_StreamOfAnotherDay_IsTakenAgainWhileItIsFree', async () => {
    const old = { title: 'Ada, performing', model: 'm' };
    const another = stream('another', { ...old, model: 'head of the same name' });
    const { server, model } = await setUp([another, stream('taken', { ...old, publishers: 1 }), stream('old', old)]);
    await model.play();
    expect(server.asked[0]?.stream).toBe('old');
  });

  test('Follow_OwnStream_BecomesTheTarget_TheDemoDoesNot', async () => {
    const { live, model } = await setUp([stream('demo', { source: 'demo' }), stream('a')]);
    live.subscribe('demo');
    expect(model.target.value).toBe('');
    live.subscribe('a');
    expect(model.target.value).toBe('a');
  });

  test('Position_BetweenNews_GoesOnWithTheClock', async () => {
    const { model, clock } = await setUp([stream('a')]);
    model.target.set('a');
    await model.play({ from: 500 });
    clock.now += 1200;
    expect(model.position).toBe(1700);
    clock.now += 60_000;
    expect(model.position).toBe(4000);
    model.tick();
    expect(model.playing.value).toBeNull();
  });

  test('Position_OfALoop_BeginsAgain', async () => {
    const { model, clock } = await setUp([stream('a')]);
    model.target.set('a');
    model.loop = true;
    await model.play();
    clock.now += 9000;
    expect(model.position).toBe(1000);
    model.tick();
    expect(model.playing.value).not.toBeNull();
  });

  test('PlayAgain_WhatWasStartedHere_TakesOverFromItself', async () => {
    const { server, model } = await setUp([stream('a')]);
    model.target.set('a');
    await model.play();
    expect(model.mine).toBe(true);
    await model.play({ from: 2000 });
    expect(server.asked[1]?.options).toEqual({ loop: false, from: 2000, take_over: true });
  });

  test('Play_BusyStream_SaysWhoAndTakesOverWhenAsked', async () => {
    const { server, model } = await setUp([stream('a', { playing: playing({ id: 'other', name: 'Aria' }) })]);
    model.target.set('a');
    expect(model.mine).toBe(false);
    server.refuse = { type: '/problems/conflict', title: 'Conflict', status: 409, detail: 'something plays' };
    await model.play();
    expect(server.asked[0]?.options.take_over).toBe(false);
    expect(model.refusal.value?.holder).toContain('Aria');
    server.refuse = null;
    await model.play({ take_over: true });
    expect(model.refusal.value).toBeNull();
    expect(server.asked[1]?.options.take_over).toBe(true);
  });

  test('Play_SomebodySends_SaysSo', async () => {
    const { server, model } = await setUp([stream('a', { publishers: 1 })]);
    model.target.set('a');
    server.refuse = { type: '/problems/conflict', title: 'Conflict', status: 409 };
    await model.play();
    expect(model.refusal.value?.holder).toBe('Another client publishes to this stream.');
  });

  test('Play_RefusedDocument_ShowsWhere', async () => {
    const { server, model } = await setUp([stream('a')]);
    model.target.set('a');
    const pointer = '/cues/0/viseme';
    const type = '/problems/invalid-performance';
    server.refuse = { type, title: 'Invalid', status: 422, detail: 'no viseme', pointer };
    await model.play();
    expect(model.refusal.value?.holder).toBeNull();
    expect(model.refusal.value?.excerpt.find(({ marked }) => marked)?.number).toBe(2);
    model.choose({ kind: 'performance', title: 'other.json', text: '{}' });
    expect(model.refusal.value).toBeNull();
  });

  test('Play_FapFile_GoesTheWayOfFapFiles', async () => {
    const { server, model } = await setUp([stream('a')]);
    model.target.set('a');
    model.choose({ kind: 'fap', title: 'joy.fap', text: '2.1 joy 25 1' });
    model.absent.set('keep');
    await model.play();
    expect(server.faps).toEqual(['keep']);
    expect(model.playing.value).not.toBeNull();
    expect(model.warnings.value).toEqual(['line 2: 69 flags']);
    model.choose({ kind: 'performance', title: 'other.json', text: '{}' });
    expect(model.warnings.value).toEqual([]);
  });

  test('Stop_EndsWhatPlaysThere', async () => {
    const { server, model } = await setUp([stream('a', { playing: playing({ id: 'other' }) })]);
    model.target.set('a');
    await model.stop();
    expect(server.stopped).toEqual(['other']);
    expect(model.playing.value).toBeNull();
  });

  test('Target_StreamThatIsDeleted_GoesBackToANewOne', async () => {
    const { server, live, model } = await setUp([stream('a')]);
    model.target.set('a');
    server.streams = [];
    await live.refresh();
    expect(model.target.value).toBe('');
  });
});

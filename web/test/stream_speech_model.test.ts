import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';
import { neutralFrame } from '@client/index.ts';
import { ApiError } from '../src/net/problem.ts';
import type { Playing, Recording, StreamInfo, StreamSpeech } from '../src/net/types.ts';
import { FaceDriver } from '../src/ui/stage/face_driver.ts';
import { StreamSpeechModel } from '../src/ui/speak/stream_speech_model.ts';
import type { Studio } from '../src/ui/shared/studio.ts';
import { FakeLive } from './support/fake_live.ts';

/** A server with one stream; what was asked of it is written down. */
class FakeServer {
  stream = { id: 's1', title: 'One', source: 'none', publishers: 0, active_source: null, playing: null, failed: null } as unknown as StreamInfo;
  readonly asked: string[] = [];
  refuse: ApiError | null = null;

  readonly listStreams = (): Promise<StreamInfo[]> => Promise.resolve([structuredClone(this.stream)]);
  readonly speakIntoStream = (id: string, { text, take_over }: StreamSpeech): Promise<Playing> => {
    this.asked.push(`speak ${id} ${text}${take_over ? ' take over' : ''}`);
    if (this.refuse) return Promise.reject(this.refuse);
    const playing = { id: 'p1' } as Playing;
    this.stream = { ...this.stream, playing, active_source: 'performance' };
    return Promise.resolve(playing);
  };
  readonly stopPlaying = (id: string, playing: string): Promise<void> => {
    this.asked.push(`stop ${id} ${playing}`);
    return Promise.resolve();
  };
  readonly startRecording = (stream: string): Promise<Recording> => {
    this.asked.push(`record ${stream}`);
    return Promise.resolve({ id: 'r1', stream, duration: 0 } as Recording);
  };
  readonly stopRecording = (id: string): Promise<Recording> => {
    this.asked.push(`end ${id}`);
    return Promise.resolve({ id, stream: 's1', duration: 1200 } as Recording);
  };
  readonly deleteRecording = (id: string): Promise<void> => {
    this.asked.push(`delete ${id}`);
    return Promise.resolve();
  };
  readonly deleteSpeech = (id: string): Promise<void> => {
    this.asked.push(`forget ${id}`);
    return Promise.resolve();
  };
}

let server: FakeServer;
let live: FakeLive;
let model: StreamSpeechModel;
const speech = (): Promise<StreamSpeech> => Promise.resolve({ text: 'Olá' });

beforeEach(async () => {
  vi.useFakeTimers();
  server = new FakeServer();
  live = new FakeLive({ api: server } as unknown as Studio, neutralFrame(), new FaceDriver(neutralFrame()));
  await live.refresh();
  model = new StreamSpeechModel(server, live);
  model.target.set('s1');
});
afterEach(() => vi.useRealTimers());

describe('StreamSpeechModel', () => {
  test('say_Text_IsFollowedHeardAndRecordedUntilItHasBeenSaid', async () => {
    expect(await model.say(speech, false)).toBeNull();
    expect(live.following.value).toBe('s1');
    expect(live.sound.value).toBe(true);
    expect(live.driver.source.value).toBe('stream');
    expect(model.state.value).toMatchObject({ kind: 'speaking', stream: 's1', recording: { id: 'r1' } });
    await vi.advanceTimersByTimeAsync(2000);
    expect(server.asked).toEqual(['record s1', 'speak s1 Olá']);
    server.stream = { ...server.stream, playing: null };
    await vi.advanceTimersByTimeAsync(1000);
    expect(server.asked.at(-1)).toBe('end r1');
    expect(model.state.value).toMatchObject({ kind: 'done', recording: { duration: 1200 }, failure: null });
  });

  test('say_RecordingOff_RecordsNothing', async () => {
    model.records.set(false);
    await model.say(speech, false);
    server.stream = { ...server.stream, playing: null };
    await vi.advanceTimersByTimeAsync(1000);
    expect(server.asked).toEqual(['speak s1 Olá']);
    expect(model.state.value).toEqual({ kind: 'done', recording: null, failure: null });
  });

  test('say_RestCannotBeMade_KeepsTheRecordingAndSaysWhy', async () => {
    await model.say(speech, false);
    server.stream = { ...server.stream, playing: null, failed: { id: 'p1', failure: 'the voice program ended' } as Playing };
    await vi.advanceTimersByTimeAsync(1000);
    expect(model.state.value).toMatchObject({ kind: 'done', recording: { id: 'r1' }, failure: 'the voice program ended' });
  });

  test('say_NoVoice_SaysSoAndKeepsNoRecording', async () => {
    server.refuse = new ApiError({ type: 'no-voice', title: 'No voice', status: 501, detail: 'there is no voice' });
    expect(await model.say(speech, false)).toBeNull();
    expect(model.state.value).toMatchObject({ kind: 'failed' });
    expect(server.asked.slice(-2)).toEqual(['end r1', 'delete r1']);
  });

  test('say_AnotherSource_AsksAndTakesOver', async () => {
    server.stream = { ...server.stream, active_source: 'connection' };
    server.refuse = new ApiError({ type: 'conflict', title: 'Conflict', status: 409, detail: 'somebody publishes' });
    expect(await model.say(speech, false)).toBe('somebody publishes');
    expect(model.state.value).toEqual({ kind: 'off' });
    server.refuse = null;
    expect(await model.say(speech, true)).toBeNull();
    expect(server.asked.at(-1)).toBe('speak s1 Olá take over');
  });

  test('say_WhileItSpeaks_EndsWhatIsSaid', async () => {
    await model.say(speech, false);
    await model.say(speech, false);
    expect(server.asked).toEqual(['record s1', 'speak s1 Olá', 'stop s1 p1', 'end r1', 'record s1', 'speak s1 Olá']);
  });

  test('say_StoredSpeechRefused_IsForgotten', async () => {
    server.refuse = new ApiError({ type: 'no-stream', title: 'No stream', status: 404 });
    await model.say(() => Promise.resolve({ speech: 'x1' }), false);
    expect(server.asked).toContain('forget x1');
  });

  test('stop_WhileItSpeaks_KeepsTheRecording', async () => {
    await model.say(speech, false);
    await model.stop();
    expect(server.asked.slice(-2)).toEqual(['stop s1 p1', 'end r1']);
    expect(model.state.value).toMatchObject({ kind: 'done', recording: { id: 'r1' } });
  });
});

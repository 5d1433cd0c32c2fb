import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { neutralFrame } from '@client/index.ts';
import type { StreamInfo } from '../src/net/types.ts';
import { LiveModel } from '../src/ui/live/live_model.ts';
import { LiveSound } from '../src/ui/live/live_sound.ts';
import { Signal } from '../src/ui/shared/signal.ts';
import type { Studio } from '../src/ui/shared/studio.ts';
import { FaceDriver } from '../src/ui/stage/face_driver.ts';

/** A device for sound that begins when the test lets it. */
const device = vi.hoisted(() => ({ begin: (): void => undefined, output: {} }));
vi.mock('@client/sound/index.ts', () => ({
  StreamSound: class {
    static readonly isSupported = true;
    readonly output = device.output;
    readonly start = (): Promise<void> => new Promise((begin) => (device.begin = begin));
    readonly stop = (): Promise<void> => Promise.resolve();
    readonly dispose = (): void => undefined;
  },
}));

class OpenSocket {
  onopen: (() => void) | null = null;
  readonly addEventListener = (): void => undefined;
  readonly close = (): void => undefined;
}

let live: LiveModel;
let sound: LiveSound;

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal('WebSocket', OpenSocket);
  const stream = { id: 's1', title: 'One', source: 'none', publishers: 0, playing: null, model: null } as unknown as StreamInfo;
  const api = { listStreams: () => Promise.resolve([stream]), streamUrl: () => 'ws://x' };
  const studio = { api, selected: new Signal(null) } as unknown as Studio;
  const driver = new FaceDriver(neutralFrame());
  live = new LiveModel(studio, neutralFrame(), driver);
  sound = new LiveSound(live, driver, () => null);
});
afterEach(() => {
  live.unsubscribe();
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

/** Opens the stream to play into it, and notes when that is done. */
function opening(): { done: boolean } {
  const state = { done: false };
  void live.openFor('s1').then(() => (state.done = true));
  return state;
}

test('StreamToPlayInto_IsOpen_WhenItsSoundIsHeard', async () => {
  live.sound.set(true);
  const state = opening();
  await vi.advanceTimersByTimeAsync(3000); // a slow page: the connection was waited for
  expect(state.done).toBe(false);
  expect(sound.output.value).toBeNull();
  device.begin();
  await vi.advanceTimersByTimeAsync(10);
  expect(state.done).toBe(true);
  expect(sound.output.value).toBe(device.output);
});

test('SoundThatNeverBegins_IsNotWaitedForWithoutEnd', async () => {
  live.sound.set(true);
  const state = opening();
  await vi.advanceTimersByTimeAsync(60_000);
  expect(state.done).toBe(true);
});

test('WithoutSound_NothingIsWaitedFor', async () => {
  const state = opening();
  await vi.advanceTimersByTimeAsync(2100);
  expect(state.done).toBe(true);
});

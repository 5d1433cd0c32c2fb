import { expect, test } from 'vitest';
import { neutralFrame } from '@client/index.ts';
import type { StreamInfo } from '../src/net/types.ts';
import { Signal } from '../src/ui/shared/signal.ts';
import type { Studio } from '../src/ui/shared/studio.ts';
import { FaceDriver } from '../src/ui/stage/face_driver.ts';
import { FakeLive } from './support/fake_live.ts';

/** A server with streams, and the page that follows them. */
function open(streams: StreamInfo[]): { live: FakeLive; deleted: string[] } {
  const deleted: string[] = [];
  const api = {
    listStreams: () => Promise.resolve(structuredClone(streams)),
    createStream: (title: string, model: string) => {
      const stream = { id: `s${streams.length}`, title, model, source: 'none', subscribers: 1, publishers: 0, playing: null } as unknown as StreamInfo;
      streams.push(stream);
      return Promise.resolve(stream);
    },
    deleteStream: (id: string, keepalive: boolean) => {
      deleted.push(`${id} ${keepalive ? 'although the page closes' : ''}`);
      return Promise.resolve();
    },
  };
  const studio = {
    api,
    selected: new Signal({ id: 'ana', name: 'Ana' }),
    attempt: (_: string, action: () => Promise<void>) => action(),
  } as unknown as Studio;
  return { live: new FakeLive(studio, neutralFrame(), new FaceDriver(neutralFrame())), deleted };
}

const change = async (live: FakeLive, streams: StreamInfo[], to: Partial<StreamInfo>): Promise<void> => {
  streams[0] = { ...streams[0]!, ...to };
  await live.refresh();
};

test('Leave_OfAStreamThatThePageMadeToPlayInto_EndsIt', async () => {
  const { live, deleted } = open([]);
  expect(await live.openFor('')).toBe('s0');
  live.leave();
  expect(deleted).toEqual(['s0 although the page closes']);
});

test.each<[string, Partial<StreamInfo>]>([
  ['somebody else watches', { subscribers: 2 }],
  ['somebody feeds', { publishers: 1 }],
  ['plays in a loop', { playing: { id: 'p', loop: true } as StreamInfo['playing'] }],
])('Leave_OfAStreamThat %s_KeepsIt', async (_, state) => {
  const streams: StreamInfo[] = [];
  const { live, deleted } = open(streams);
  await live.openFor('');
  await change(live, streams, state);
  live.leave();
  expect(deleted).toEqual([]);
});

test('Leave_OfAStreamThatWasThere_KeepsIt', async () => {
  const streams = [{ id: 's0', title: 'Ana, performing', model: 'ana', source: 'none', subscribers: 0, publishers: 0, playing: null } as unknown as StreamInfo];
  const { live, deleted } = open(streams);
  await live.refresh();
  expect(await live.openFor('')).toBe('s0');
  live.leave();
  expect(deleted).toEqual([]);
});

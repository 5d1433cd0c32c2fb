import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { beforeAll, describe, expect, it, vi } from 'vitest';
import { Player, StreamClient, type PoseMaker, type StreamOptions } from '../../../../clients/js/index.ts';
import { Bridges, Performance, type Library } from '../../../../clients/js/motion/index.ts';
import { FakeSocket } from '../support/fake_socket.ts';
import { loadLibrary, loadRuntime } from '../support/runtime.ts';

setFlagsFromString('--expose-gc');
const collect = runInNewContext('gc') as () => void;

const hello = readFileSync(fileURLToPath(new URL('../../../../protocol/examples/performances/hello.json', import.meta.url)));

let library: Library;
beforeAll(async () => {
  [library] = await Promise.all([loadLibrary(), loadRuntime()]);
});

/** A client whose stream, and a player whose memory the library has made. */
function followed(): { client: StreamClient; player: Player } {
  const client = new StreamClient('ws://x', { WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>, pingInterval: 0 });
  const poses: PoseMaker = { evaluateAt: () => undefined, interpolate: () => undefined };
  const player = new Player(poses);
  player.follow(client);
  vi.useFakeTimers(); // a timer of the client holds it until it is over
  client.connect();
  expect(player.stats.snaps).toBe(0);
  client.close();
  vi.clearAllTimers();
  vi.useRealTimers();
  FakeSocket.sockets = [];
  return { client, player };
}

/** The collector gives back the memory of the library that belongs to these, so it must be able to collect them. */
describe('What was forgotten without being disposed of', () => {
  it.each<[string, () => object]>([
    ['Player', () => followed().player],
    ['StreamClient', () => followed().client],
    ['Performance', () => new Performance(library, hello)],
    ['Bridges', () => new Bridges(library)],
  ])('%s_IsCollected', async (_, make) => {
    const forgotten = new WeakRef(make());
    for (let turns = 0; forgotten.deref() !== undefined && turns < 100; turns += 1) {
      await new Promise((next) => setTimeout(next)); // a WeakRef holds its object until the end of the task
      collect();
    }
    expect(forgotten.deref()).toBeUndefined();
  });
});

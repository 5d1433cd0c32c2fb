import { afterEach, beforeAll, beforeEach, describe, expect, it, vi } from 'vitest';
import { Player, StreamClient, type PoseMaker, type StreamOptions } from '../../../../clients/js/index.ts';
import { neutralFrame, type FaceFrame, type Frames, type Header, type Message } from '../../../../protocol/ts/index.ts';
import { FakeSocket } from '../support/fake_socket.ts';
import { loadRuntime } from '../support/runtime.ts';

beforeAll(loadRuntime);

const epochs = [3, 4];
const held = 12;

/** The even chance of every run of the test. */
function chance(seed: number): (n: number) => number {
  return (n) => {
    seed = (seed * 48271) % 0x7fffffff;
    return seed % n;
  };
}

const face = (epoch: number, sequence: number): FaceFrame => {
  const frame = neutralFrame();
  frame.levels[3] = ((sequence * 7919 + epoch) % 400) - 200;
  frame.levels[48] = sequence % 100;
  return frame;
};

/** What SPEC.md, 2 asks of a server, for one subscriber. */
class Server {
  epoch = epochs[0]!;
  sequence = 0;
  clock = 0;
  private batches: Frames[] = [];
  private socket: FakeSocket | null = null;

  produce(frames: number): void {
    const batch: Frames = {
      type: 'frames',
      sequence: this.sequence + 1,
      media_time: this.clock,
      frames: Array.from({ length: frames }, (_, i) => ({ time: i * 20, state: face(this.epoch, this.sequence + 1 + i) })),
    };
    this.sequence += frames;
    this.batches.push(batch);
    if (this.batches.length > held) this.batches.shift();
    this.socket?.give(batch);
  }

  restart(epoch: number): void {
    this.epoch = epoch;
    this.sequence = this.clock = 0;
    this.batches = [];
    this.socket = null;
  }

  lose(): void {
    this.socket = null;
  }

  /** Answers the hello with the first `messages` of its answer, and lets the stream follow if that was all of it. */
  greet(socket: FakeSocket, messages: number): void {
    socket.accept();
    const hello = socket.sent[0]!;
    const resume = hello.type === 'hello' ? hello.resume : null;
    const next = this.batches.findIndex(({ sequence }) => sequence === (resume?.sequence ?? NaN) + 1);
    const newest = resume?.sequence === this.sequence;
    const recovered = resume?.epoch === this.epoch && (next >= 0 || newest);
    const sequence = recovered ? resume!.sequence : this.sequence;
    const batches = recovered && next >= 0 ? this.batches.slice(next) : [];
    const known = this.batches.find((batch) => batch.sequence <= sequence && sequence < batch.sequence + batch.frames.length);
    const answer: Message[] = [
      {
        type: 'header',
        version: 1,
        stream: 's',
        title: '',
        model: '',
        epoch: this.epoch,
        sequence: this.sequence,
        media_time: this.clock,
        server_time: 0,
        fps_hint: 50,
        batch_interval: 60,
        quantizers: [],
        recovered,
        viseme_share: null,
    sound: null,
      } satisfies Header,
      {
        type: 'keyframe',
        sequence,
        media_time: known ? known.media_time + 20 * (sequence - known.sequence) : 0,
        state: sequence === 0 ? neutralFrame() : face(this.epoch, sequence),
      },
      ...batches,
    ];
    answer.slice(0, messages).forEach((message) => socket.give(message));
    if (messages >= answer.length) this.socket = socket;
    else socket.drop();
  }
}

class NoPoses implements PoseMaker {
  evaluateAt(): void {}
  interpolate(): void {}
}

beforeEach(() => {
  vi.useFakeTimers();
  FakeSocket.sockets = [];
});
afterEach(() => {
  vi.useRealTimers();
});

describe('StreamClient', () => {
  it('Kill_TwoHundredTimes_MissesNothingThatItIsToldWasRecovered', () => {
    const below = chance(9);
    let now = 0;
    const server = new Server();
    const client = new StreamClient('ws://x', {
      WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>,
      now: () => now,
      backoff: { first: 20, longest: 40 },
    });
    const player = new Player(new NoPoses(), { now: () => now });
    player.follow(client);

    const seen = new Map<string, { level: number; media: number }>();
    const faults: string[] = [];
    let expected = NaN;
    let lastOf = { epoch: 0, sequence: 0 };
    const claims = { recovered: 0, lost: 0 };
    const take = (sequence: number, media: number, state: FaceFrame): void => {
      const epoch = client.header!.epoch;
      const key = `${epoch}/${sequence}`;
      const known = seen.get(key);
      if (sequence > 0 && state.levels[3] !== face(epoch, sequence).levels[3]) faults.push(`${key} is another face`);
      if (known && known.media !== media) faults.push(`${key} was at ${known.media}, is at ${media}`);
      seen.set(key, { level: state.levels[3]!, media });
      lastOf = { epoch, sequence };
    };
    client.on('keyframe', ({ sequence, media_time, state }) => {
      const { epoch, recovered } = client.header!;
      if (lastOf.epoch === epoch) {
        if (recovered && sequence !== lastOf.sequence) faults.push(`recovered, but ${lastOf.sequence} to ${sequence}`);
        if (!recovered && sequence <= lastOf.sequence + 1) faults.push(`nothing lost at ${sequence}`);
        claims[recovered ? 'recovered' : 'lost'] += 1;
      }
      take(sequence, media_time, state);
      expected = sequence + 1;
    });
    client.on('frames', (batch) => {
      if (batch.sequence !== expected) faults.push(`${batch.sequence} in place of ${expected}`);
      batch.frames.forEach(({ time, state }, i) => take(batch.sequence + i, batch.media_time + time, state));
      expected = batch.sequence + batch.frames.length;
    });
    client.on('fault', (fault) => faults.push(fault.message));

    const pass = (batches: number): void => {
      for (let i = 0; i < batches; ++i) {
        for (let k = 0; k < 4; ++k) {
          now += 15;
          vi.advanceTimersByTime(15);
          const before = player.playhead;
          const epoch = client.header?.epoch;
          player.update(0.015);
          if (player.playhead < before && epoch === client.header?.epoch) faults.push('played backwards');
        }
        server.clock += 60;
        server.produce(3);
      }
    };
    client.connect();
    server.greet(FakeSocket.last, 99);
    let kills = 0;
    while (kills < 200) {
      pass(1 + below(4));
      if (kills >= 100 && server.epoch === epochs[0]) server.restart(epochs[1]!);
      const sockets = FakeSocket.sockets.length;
      FakeSocket.last.drop();
      server.lose();
      pass(below(10) === 0 ? 20 : 1 + below(3)); // the backoff is over after one
      expect(FakeSocket.sockets.length).toBeGreaterThan(sockets);
      // Some connections end before the hello, after the header, or in what is made up for.
      for (kills += 1; below(3) === 0 && kills < 200; ++kills) {
        const before = FakeSocket.sockets.length;
        if (below(4) === 0) FakeSocket.last.drop();
        else server.greet(FakeSocket.last, below(2));
        pass(2);
        expect(FakeSocket.sockets.length).toBeGreaterThan(before);
      }
      server.greet(FakeSocket.last, 99);
    }
    pass(10);
    expect(faults).toEqual([]);
    expect(seen.get(`${epochs[1]!}/${server.sequence}`)?.level).toBe(face(epochs[1]!, server.sequence).levels[3]);
    expect(claims.recovered).toBeGreaterThan(80);
    expect(claims.lost).toBeGreaterThan(5);
    expect(player.stats.snaps).toBeLessThan(200);
    expect(server.clock - player.playhead).toBeLessThan(400);
  });
});

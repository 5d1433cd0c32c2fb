import { beforeAll, describe, expect, it } from 'vitest';
import {
  Player,
  shownPose,
  StreamClient,
  type PlayerOptions,
  type PoseMaker,
  type Runtime,
  type StreamOptions,
} from '../../../../clients/js/index.ts';
import { readFrame } from '../../../../clients/js/frames.ts';
import { neutralFrame, standardQuantizers, type FaceFrame, type Frames, type Header, type Keyframe } from '../../../../protocol/ts/index.ts';
import { FakeSocket, headerOf } from '../support/fake_socket.ts';
import { loadRuntime } from '../support/runtime.ts';

beforeAll(loadRuntime);

/** Poses of one number, the level of FAP 3, so that what is shown can be read. */
class NumberPoses implements PoseMaker {
  values = [0, 0, 0, 0, 0];
  evaluations = 0;
  share: number | null = null;
  setVisemeShare(share: number | null): void {
    this.share = share;
  }
  evaluateAt({ view }: Runtime, frame: number, pose: number): void {
    this.values[pose] = readFrame(view, frame, neutralFrame(), standardQuantizers).levels[3]!;
    this.evaluations += 1;
  }
  interpolate(a: number, b: number, t: number, out: number): void {
    this.values[out] = this.values[a]! * (1 - t) + this.values[b]! * t;
  }
  /** Not the kernel's curve, but one that has its slopes: enough to see which frames and spans are given. */
  ease(poses: readonly [number, number, number, number], spans: ArrayLike<number>, t: number, out: number): void {
    const [before, from, to, after] = poses.map((pose) => this.values[pose]!) as [number, number, number, number];
    const middle = (to - from) / spans[1]!;
    const first = spans[0]! > 0 ? ((from - before) / spans[0]! + middle) / 2 : 0;
    const last = spans[2]! > 0 ? ((after - to) / spans[2]! + middle) / 2 : 0;
    const s = t * t * (3 - 2 * t);
    this.values[out] =
      from * (1 - s) + to * s + spans[1]! * (t * (1 - t) * (1 - t) * first + t * t * (t - 1) * last);
  }
  get shown(): number {
    return this.values[shownPose]!;
  }
}

const state = (level: number): FaceFrame => {
  const frame = neutralFrame();
  frame.levels[3] = level;
  return frame;
};
/** Levels are media times in steps of 4 ms, so that they fit. */
const levelAt = (mediaTime: number): number => Math.round(mediaTime / 4) % 32768;
const keyframe = (mediaTime: number, level = levelAt(mediaTime)): Keyframe => ({
  type: 'keyframe',
  sequence: 1,
  media_time: mediaTime,
  state: state(level),
});
const batch = (...mediaTimes: number[]): Frames => ({
  type: 'frames',
  sequence: 1,
  media_time: mediaTimes[0]!,
  frames: mediaTimes.map((time) => ({ time: time - mediaTimes[0]!, state: state(levelAt(time)) })),
});
const header = (epoch: number): Header => headerOf({ epoch, fps_hint: 0, batch_interval: 40 });

interface Clock {
  now: number;
}

/** A server whose messages reach the player through a client. Numbers the frames. */
class Fed {
  readonly client: StreamClient;
  private sequence = 0;
  private socket: FakeSocket | null = null;

  constructor(private readonly clock: Clock) {
    this.client = new StreamClient('ws://x', {
      WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>,
      now: () => clock.now,
      pingInterval: 0,
    });
  }
  /** A new connection, whose hello was sent at `sent`. */
  begin(header: Header, sent = this.clock.now): void {
    const { now } = this.clock;
    this.clock.now = sent;
    this.socket?.drop();
    this.client.connect();
    this.socket = FakeSocket.last;
    this.socket.accept();
    this.clock.now = now;
    this.socket.give({ ...header, sequence: this.sequence });
  }
  pushKeyframe(keyframe: Keyframe): void {
    this.socket!.give({ ...keyframe, sequence: ++this.sequence });
  }
  pushFrames(frames: Frames): void {
    if (this.sequence === 0) this.pushKeyframe({ ...keyframe(0), media_time: frames.media_time, state: frames.frames[0]!.state });
    this.socket!.give({ ...frames, sequence: this.sequence + 1 });
    this.sequence += frames.frames.length;
  }
}

interface Playing {
  poses: NumberPoses;
  player: Player;
  clock: Clock;
  stream: Fed;
  step(ms: number): boolean;
}

function playing(options: PlayerOptions = {}): Playing {
  const clock = { now: 5000 };
  const poses = new NumberPoses();
  const player = new Player(poses, { now: () => clock.now, ...options });
  const stream = new Fed(clock);
  player.follow(stream.client);
  stream.begin(header(1));
  const step = (ms: number): boolean => {
    clock.now += ms;
    return player.update(ms / 1000);
  };
  return { poses, player, step, clock, stream };
}

describe('Player', () => {
  it('Update_BeforeTheFirstFrame_ShowsNothing', () => {
    const { player, step, poses } = playing();
    expect(step(16)).toBe(false);
    expect(poses.evaluations).toBe(0);
    expect(player.playhead).toBeNaN();
  });

  it('Begin_HeaderWithAShare_EvaluatesAgainByIt', () => {
    const { stream, step, poses } = playing();
    stream.pushKeyframe(keyframe(0));
    step(16);
    const before = poses.evaluations;
    stream.begin({ ...header(1), viseme_share: 0 });
    step(16);
    expect(poses.share).toBe(0);
    expect(poses.evaluations).toBeGreaterThan(before);
    stream.begin(header(1));
    step(16);
    expect(poses.share).toBeNull();
  });

  it('Update_SteadyStream_PlaysAsLittleBehindAsItMayAndInterpolates', () => {
    const { player, stream, step, poses } = playing();
    stream.pushKeyframe(keyframe(0));
    for (let media = 40; media <= 4000; media += 40) {
      for (const part of [16, 16, 8]) step(part);
      stream.pushFrames(batch(media));
    }
    // The newest is 4000; 60 ms is the least delay. A header's media time is cut to whole ms: the clock is half a ms on.
    expect(player.playhead).toBeCloseTo(3940.5, 0);
    step(10);
    expect(poses.shown * 4).toBeCloseTo(3950.5, 0); // between the frames of 3920 and 3960
  });

  it('Update_ArrivalsThatJitter_NeverGoesBackAndChangesSpeedByFivePercent', () => {
    const { player, stream, step, clock } = playing();
    stream.pushKeyframe(keyframe(0));
    let seed = 3;
    const pending: { at: number; media: number }[] = [];
    for (let media = 40; media <= 20_000; media += 40) {
      seed = (seed * 48271) % 0x7fffffff;
      pending.push({ at: 5000 + media + (seed % 60), media });
    }
    let arrived = 0;
    let slowest = Infinity;
    let fastest = 0;
    for (let i = 0; i < 1900; ++i) {
      // In order, as a socket delivers: one late message holds those behind it.
      while (pending.length > 0 && pending[0]!.at <= clock.now + 10) {
        arrived = pending.shift()!.media;
        stream.pushFrames(batch(arrived));
      }
      const before = player.playhead;
      step(10);
      const moved = player.playhead - before;
      expect(moved).toBeGreaterThanOrEqual(0);
      if (i > 10 && player.playhead < arrived) {
        slowest = Math.min(slowest, moved);
        fastest = Math.max(fastest, moved);
      }
    }
    expect(slowest).toBeGreaterThanOrEqual(9.5 - 1e-6);
    expect(fastest).toBeLessThanOrEqual(10.5 + 1e-6);
  });

  it('Update_NoNewFrames_HoldsTheLastOne', () => {
    const { player, stream, step, poses } = playing();
    stream.pushKeyframe(keyframe(0));
    stream.pushFrames(batch(40, 80, 120));
    for (let i = 0; i < 50; ++i) step(16);
    expect(player.playhead).toBe(120);
    expect(poses.shown).toBe(levelAt(120));
    expect(step(16)).toBe(false); // nothing changed: nothing to draw
  });

  it('Update_AfterALongSilence_JumpsAndMovesAtTheUsualPace', () => {
    const { player, stream, step, poses, clock } = playing();
    stream.pushKeyframe(keyframe(0));
    for (let i = 0; i < 100; ++i) step(16);
    clock.now = 5000 + 60_000;
    stream.pushFrames(batch(60_000));
    step(16);
    expect(player.playhead).toBeGreaterThan(59_900);
    expect(poses.shown).toBeLessThan(levelAt(30_000)); // begins from the old face, not half way through the silence
    for (let i = 0; i < 20; ++i) step(16);
    expect(poses.shown).toBe(levelAt(60_000));
  });

  it('Push_FramesSentAgain_AreIgnored', () => {
    const { stream, step, poses } = playing();
    stream.pushKeyframe(keyframe(0));
    stream.pushFrames(batch(40, 80));
    stream.pushKeyframe(keyframe(40, -1000));
    stream.pushFrames(batch(80, 120));
    for (let i = 0; i < 50; ++i) {
      step(16);
      expect(poses.shown).toBeGreaterThanOrEqual(0);
    }
    expect(poses.shown).toBe(levelAt(120));
  });

  it('Begin_AnotherEpoch_StartsANewTimeLine', () => {
    const { stream, step, poses } = playing();
    stream.pushKeyframe(keyframe(100_000));
    step(16);
    stream.begin(header(2));
    stream.pushKeyframe(keyframe(12));
    step(200);
    expect(poses.shown).toBe(levelAt(12));
  });

  it('Push_WithoutUpdates_HoldsABoundedNumberOfFrames', async () => {
    const runtime = await loadRuntime();
    const { player, stream, step, clock } = playing();
    for (let media = 40; media <= 100_000; media += 40) stream.pushFrames(batch(media));
    const size = runtime.bytes.length;
    for (let media = 100_040; media <= 400_000; media += 40) stream.pushFrames(batch(media));
    expect(runtime.bytes.length).toBe(size);
    clock.now += 400_000;
    for (let i = 0; i < 100; ++i) step(16);
    expect(player.playhead).toBe(400_000);
  });

  it('Update_Eased_HasNoCornersAndPassesTheFrames', () => {
    const corners = (interpolation: 'linear' | 'eased'): number => {
      const { stream, step, poses } = playing({ interpolation, delay: 200 });
      // Levels that turn about at every other frame.
      const level = (media: number): number => Math.round(2000 * Math.sin(media / 90));
      stream.pushKeyframe(keyframe(0, 0));
      const shown: number[] = [];
      for (let media = 40; media <= 4000; media += 40) {
        stream.pushFrames({ ...batch(media), frames: [{ time: 0, state: state(level(media)) }] });
        for (let part = 0; part < 20; ++part) {
          step(2);
          shown.push(poses.shown);
        }
      }
      let worst = 0;
      for (let i = 202; i < shown.length; ++i) {
        worst = Math.max(worst, Math.abs(shown[i]! - 2 * shown[i - 1]! + shown[i - 2]!));
      }
      return worst;
    };
    expect(corners('eased')).toBeLessThan(corners('linear') / 3);
  });

  it('Update_Eased_AFrameThatArrivesLate_BendsNothingThatIsShown', () => {
    const { stream, step, poses } = playing({ interpolation: 'eased', delay: 40 });
    stream.pushKeyframe(keyframe(0, 0));
    stream.pushFrames({ ...batch(40), frames: [{ time: 0, state: state(1000) }] });
    for (let i = 0; i < 30; ++i) step(2);
    const before = poses.shown;
    stream.pushFrames({ ...batch(80), frames: [{ time: 0, state: state(4000) }] });
    step(0.01);
    expect(Math.abs(poses.shown - before)).toBeLessThan(5);
  });

  it('Update_PageHeldUpForAMoment_GoesOnWhereItShouldBe', () => {
    const { player, stream, step, clock } = playing({ delay: 200 });
    stream.pushKeyframe(keyframe(0));
    for (let media = 40; media <= 4000; media += 40) {
      stream.pushFrames(batch(media));
      step(40);
    }
    for (let media = 4040; media <= 4320; media += 40) {
      clock.now += 40;
      stream.pushFrames(batch(media));
    }
    player.update(1 / 60); // as a page that bounds its steps says
    // The header said at 5000 that the stream's clock was between 0 and 1.
    expect(clock.now - 4999.5 - player.playhead).toBeCloseTo(player.delay, 0);
    expect(player.stats.snaps).toBe(0);
  });

  it('Update_TabHiddenForMinutes_ShowsThePresentAtOnce', () => {
    const { player, stream, step, clock } = playing({ delay: 200 });
    stream.pushKeyframe(keyframe(0));
    for (let media = 40; media <= 600_000; media += 40) {
      clock.now += 40;
      stream.pushFrames(batch(media));
      if (media < 4000) player.update(0.04);
    }
    step(16);
    expect(player.playhead).toBeGreaterThan(599_750);
    expect(player.stats.starved).toBe(0);
  });

  it('Follow_TwoPlayersOfOneDelayOnUnlikeNetworks_ShowTheSameMoment', () => {
    const clock = { now: 0 };
    const players = [5, 180].map((latency) => {
      const player = new Player(new NumberPoses(), { now: () => clock.now, delay: 400 });
      const stream = new Fed(clock);
      player.follow(stream.client);
      clock.now = latency;
      stream.begin(header(1), -latency);
      return { player, stream, latency };
    });
    for (clock.now = 180; clock.now < 4000; clock.now += 5) {
      for (const { player, stream, latency } of players) {
        const sent = clock.now - latency;
        if (sent >= 0 && sent % 40 === 0) stream.pushFrames(batch(sent));
        player.update(0.005);
      }
    }
    const [near, far] = players;
    expect(near!.player.playhead).toBeGreaterThan(3500);
    expect(Math.abs(near!.player.playhead - far!.player.playhead)).toBeLessThan(2);
  });

  it('Update_WithAClock_ShowsExactlyWhatItSays', () => {
    let sound = NaN;
    const { player, stream, step, poses } = playing({ clock: () => sound });
    stream.pushKeyframe(keyframe(0));
    step(16); // no sound yet: by the display's clock
    for (let media = 40; media <= 4000; media += 40) stream.pushFrames(batch(media));
    for (const time of [1000, 1007.5, 1033, 1700]) {
      sound = time;
      step(16);
      expect(player.playhead).toBe(time);
      expect(poses.shown * 4).toBeCloseTo(time, 3);
    }
    sound = 1500; // the clock of a sound card corrects itself
    step(16);
    expect(player.playhead).toBe(1700);
    sound = 1710;
    step(16);
    expect(player.playhead).toBe(1710);
    sound = 9000;
    step(16);
    expect(player.playhead).toBe(4000); // not past the newest frame
    expect(player.updateTo(NaN)).toBe(false);
  });

  it('UpdateTo_FarBack_FollowsToTheOldestFrameHeld', () => {
    const { player, stream, poses } = playing();
    stream.pushKeyframe(keyframe(0));
    for (let media = 40; media <= 4000; media += 40) stream.pushFrames(batch(media));
    player.updateTo(2000);
    player.updateTo(400);
    expect(player.playhead).toBe(400);
    expect(poses.shown).toBe(levelAt(2000)); // what was before is gone
  });

  it('Follow_WhileTheFaceRests_ShowsWhatItLooksLike', () => {
    const { stream, clock } = playing();
    stream.pushKeyframe(keyframe(400));
    clock.now += 10_000;
    const poses = new NumberPoses();
    const late = new Player(null, { now: () => clock.now });
    late.follow(stream.client);
    expect(late.update(0.016)).toBe(false); // no poses are set that could be evaluated
    late.show(poses);
    expect(late.update(0.016)).toBe(true);
    expect(poses.shown).toBe(levelAt(400));
  });

  it('Follow_Stopped_ShowsNothingNewAndForgetsTheShare', () => {
    const clock = { now: 5000 };
    const poses = new NumberPoses();
    const player = new Player(poses, { now: () => clock.now });
    const stream = new Fed(clock);
    const stop = player.follow(stream.client);
    stream.begin({ ...header(1), viseme_share: 0.25 });
    stream.pushKeyframe(keyframe(0));
    player.update(0.016);
    expect(poses.share).toBe(0.25);
    stop();
    expect(poses.share).toBeNull();
    stream.pushFrames(batch(40, 80));
    clock.now += 500;
    player.update(0.5);
    expect(poses.shown).toBe(0);
  });

  it('Dispose_OfManyClientsAndPlayers_GivesTheMemoryBack', async () => {
    const runtime = await loadRuntime();
    const use = (): void => {
      const { player, stream, step } = playing();
      stream.pushKeyframe(keyframe(0));
      step(16);
      player.dispose();
      stream.client.dispose();
      expect(step(16)).toBe(false);
      expect(stream.client.state).toBe('closed');
    };
    use();
    const size = runtime.bytes.length;
    for (let i = 0; i < 500; ++i) use();
    expect(runtime.bytes.length).toBe(size);
  });
});

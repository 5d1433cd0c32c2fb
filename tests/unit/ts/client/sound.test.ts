import { beforeAll, describe, expect, it, vi } from 'vitest';
import { Player, StreamClient, type PoseMaker, type StreamOptions } from '../../../../clients/js/index.ts';
import { SoundSchedule, StreamSound } from '../../../../clients/js/sound/index.ts';
import { neutralFrame, opusPacketMs, type Header, type Message } from '../../../../protocol/ts/index.ts';
import { FakeSocket, headerOf } from '../support/fake_socket.ts';
import { loadRuntime } from '../support/runtime.ts';

beforeAll(loadRuntime);

/** One frame of 60 ms. */
const packet = Uint8Array.of(0x18, 1, 2, 3);

describe('SoundSchedule', () => {
  const place = (schedule: SoundSchedule, mediaTime: number, now: number, shown: number): number =>
    schedule.place({ mediaTime, duration: 60 }, now, shown);

  it('Packets_WithoutAGap_AreHeardWithoutAGap', () => {
    const schedule = new SoundSchedule();
    expect(place(schedule, 1000, 500, 900)).toBe(600);
    expect(place(schedule, 1060, 570, 980)).toBe(660); // the face's time has jittered; the sound does not
    expect(schedule.heardAt(599)).toBeNaN();
    expect(schedule.heardAt(600)).toBe(1000);
    expect(schedule.heardAt(719)).toBe(1119);
    expect(schedule.heardAt(720)).toBeNaN();
  });

  it('Packet_AfterAPause_BeginsAtTheDelayOfTheFrames', () => {
    const schedule = new SoundSchedule();
    place(schedule, 1000, 500, 900);
    expect(place(schedule, 2000, 1500, 1950)).toBe(1550);
  });

  it('Packet_ThatComesWhileThePauseIsStillToCome_DoesNotCutWhatIsHeard', () => {
    const schedule = new SoundSchedule();
    place(schedule, 1000, 500, 900);
    place(schedule, 1120, 590, 1100); // would begin at 610, within the first
    expect(schedule.heardAt(650)).toBe(1050);
    expect(schedule.heardAt(670)).toBe(1130);
  });

  it('LatePacket_BeginsAsSoonAsItCan_AndTheFaceFollows', () => {
    const schedule = new SoundSchedule();
    place(schedule, 1000, 500, 900);
    expect(place(schedule, 1060, 800, 1200)).toBe(815);
    expect(schedule.heardAt(815)).toBe(1060);
    expect(place(schedule, 1120, 810, 1210)).toBe(875);
  });

  it('Packet_WhoseFaceIsOver_IsLeftOut', () => {
    const schedule = new SoundSchedule();
    expect(place(schedule, 1000, 500, 1600)).toBeNaN();
    expect(schedule.heardAt(520)).toBeNaN();
  });

  it('Packet_OfAnUnknownClock_IsLeftOut', () => {
    expect(place(new SoundSchedule(), 1000, 500, NaN)).toBeNaN();
  });

  it('PacketAgain_IsLeftOut', () => {
    const schedule = new SoundSchedule();
    place(schedule, 1000, 500, 900);
    expect(place(schedule, 1000, 510, 910)).toBeNaN();
  });

  it('AnHourOfTalk_OnADeviceWhoseClockIsFast_StaysWithTheStream', () => {
    const schedule = new SoundSchedule();
    let worst = 0;
    // 300 ppm; ten packets, then a pause of 240 ms
    for (let media = 0; media < 3_600_000; media += 60) {
      const output = media * 1.0003;
      if (media % 840 < 600) {
        const at = place(schedule, media, output, media - 100);
        worst = Math.max(worst, Math.abs(at / 1.0003 - (media + 100)));
      }
    }
    expect(worst).toBeLessThanOrEqual(20);
  });
});

/** A device for sound whose clock the test moves. What is heard, and when, is read from what it was told to play. */
class Device {
  state = 'running';
  stopped = 0;
  suspend = async (): Promise<void> => undefined;
  baseLatency = 0;
  outputLatency = 0.02;
  destination = null;
  readonly played: { at: number; mediaTime: number; duration: number }[] = [];
  static one: Device;
  constructor() {
    Device.one = this;
  }
  get currentTime(): number {
    return (world.now - 1000) * (1 + 50e-6) * 1e-3;
  }
  resume = async (): Promise<void> => undefined;
  close = async (): Promise<void> => undefined;
  /** NaN: silence */
  get heard(): number {
    const now = (this.currentTime - this.outputLatency) * 1000;
    const heard = this.played.filter(({ at, duration }) => now >= at * 1000 - 20 && now < at * 1000 - 20 + duration);
    if (heard.length > 1) throw new Error('two packets at once');
    return heard[0] ? heard[0].mediaTime + now - (heard[0].at * 1000 - 20) : NaN;
  }
}
const world = { now: 0 };

interface Decoded {
  timestamp: number;
  numberOfFrames: number;
  numberOfChannels: number;
  sampleRate: number;
  copyTo(): void;
  close(): void;
}
let decoding = 0;
class Decoder {
  state = 'unconfigured';
  decodeQueueSize = 0;
  constructor(private readonly given: { output: (data: Decoded) => void }) {}
  configure(): void {
    this.state = 'configured';
  }
  decode({ timestamp, data }: { timestamp: number; data: Uint8Array }): void {
    decoding = timestamp / 1000;
    this.given.output({
      timestamp,
      numberOfFrames: opusPacketMs(data)! * 48,
      numberOfChannels: 1,
      sampleRate: 48_000,
      copyTo: () => undefined,
      close: () => undefined,
    });
  }
  close(): void {
    this.state = 'closed';
  }
}
class Source {
  onended: (() => void) | null = null;
  constructor(
    readonly context: Device,
    readonly given: { buffer: { length: number } },
  ) {}
  connect(): void {}
  start(at: number): void {
    expect(at).toBeGreaterThanOrEqual(this.context.currentTime);
    this.context.played.push({ at, mediaTime: decoding, duration: this.given.buffer.length / 48 });
  }
  stop(): void {
    this.context.stopped += 1;
  }
}
vi.stubGlobal('AudioContext', Device);
vi.stubGlobal('AudioDecoder', Decoder);
vi.stubGlobal('EncodedAudioChunk', class {
  constructor(given: object) {
    Object.assign(this, given);
  }
});
vi.stubGlobal('AudioBuffer', class {
  readonly length: number;
  constructor({ length }: { length: number }) {
    this.length = length;
  }
  getChannelData = (): Float32Array => new Float32Array(0);
});
vi.stubGlobal('AudioBufferSourceNode', Source);

const poses: PoseMaker = { evaluateAt: () => undefined, interpolate: () => undefined };
const track = { codec: 'opus' as const, rate: 48_000, channels: 1, bitrate: 20_000 };

/**
 * A face that talks and a client that joins in the middle, over a network as of a TCP connection: in order, each message late by
 * `jitter` at most, stalled and broken at times. Media time is `now` of the world.
 */
async function watch(jitter: number, seconds: number, events: { stall?: number; breaks?: number }) {
  world.now = 10_000;
  const client = new StreamClient('ws://x', {
    WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>,
    now: () => world.now,
    pingInterval: 0,
    sound: true,
  });
  const player: Player = new Player(poses, { now: () => world.now, clock: () => sound.mediaTime });
  const sound: StreamSound = new StreamSound(client, player);
  player.follow(client);
  await sound.start();

  let seed = 7;
  const random = (): number => (seed = (seed * 48271) % 0x7fffffff) / 0x7fffffff;
  let sequence = 0;
  let socket: FakeSocket | null = null;
  let open = false;
  let onTheWay: { at: number; message: Message }[] = [];
  const send = (message: Message): void => {
    if (!open) return;
    const held = events.stall !== undefined && world.now >= events.stall && world.now < events.stall + 350;
    const at = Math.max(onTheWay.at(-1)?.at ?? 0, (held ? events.stall! + 350 : world.now) + 20 + random() * jitter);
    onTheWay.push({ at, message });
  };
  const header = (): Header => headerOf({ epoch: 1, sequence, media_time: world.now, fps_hint: 25, batch_interval: 40, sound: track });
  const face = (): Message => ({ type: 'keyframe', sequence, media_time: world.now, state: neutralFrame() });
  const connect = (): void => {
    client.connect();
    socket = FakeSocket.last;
    socket.accept();
    open = true;
    onTheWay = [];
    send(header());
    send(face());
  };
  const skews: number[] = [];
  let heardFor = 0;
  const begin = world.now;
  for (let step = 0; step < seconds * 250; step += 1) {
    world.now = begin + step * 4;
    const at = step * 4;
    if (at === 400) connect();
    if (events.breaks !== undefined && world.now === events.breaks) {
      open = false;
      onTheWay = [];
      socket!.drop();
    }
    if (events.breaks !== undefined && world.now === events.breaks + 1200) connect();
    // Phrases of 1.8 s with pauses of 360 ms.
    if (at % 60 === 0 && at % 2160 < 1800) send({ type: 'sound', media_time: world.now, packet });
    if (at % 40 === 0) {
      sequence += 1;
      send({ type: 'frames', sequence, media_time: world.now, frames: [{ time: 0, state: neutralFrame() }] });
    }
    while (onTheWay[0] && onTheWay[0].at <= world.now) socket!.give(onTheWay.shift()!.message);
    if (step % 4 !== 0) continue;
    player.update(0.016);
    const { heard } = Device.one;
    if (Number.isNaN(heard)) continue;
    heardFor += 16;
    skews.push(Math.abs(player.playhead - heard));
  }
  client.dispose();
  skews.sort((a, b) => a - b);
  return { p99: skews[Math.floor(skews.length * 0.99)]!, most: skews.at(-1)!, heard: heardFor / (seconds * 1000) };
}

describe('StreamSound', () => {
  it.each([
    { name: 'a quiet network', jitter: 5, events: {}, heard: 0.78 },
    { name: 'jitter', jitter: 120, events: {}, heard: 0.78 },
    { name: 'a stall', jitter: 40, events: { stall: 20_000 }, heard: 0.76 },
    { name: 'a lost connection', jitter: 40, events: { breaks: 20_000 }, heard: 0.7 },
  ])('Skew_OfSoundAndFace_IsBelow40ms: $name', async ({ jitter, events, heard }) => {
    const measured = await watch(jitter, 40, events);
    expect(measured.p99).toBeLessThanOrEqual(40);
    expect(measured.heard).toBeGreaterThan(heard);
  });

  it('SoundOff_AndAnotherEpoch_EndWhatWasToBePlayed_AReconnectionDoesNot', async () => {
    world.now = 50_000;
    const client = new StreamClient('ws://x', {
      WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>,
      now: () => world.now,
      sound: true,
    });
    const player = new Player(poses, { now: () => world.now });
    player.follow(client);
    const sound = new StreamSound(client, player);
    await sound.start();
    const say = (epoch: number, mediaTime: number): void => {
      client.connect();
      FakeSocket.last.accept();
      FakeSocket.last.give(headerOf({ epoch, media_time: mediaTime, sound: track }));
      FakeSocket.last.give({ type: 'keyframe', sequence: 1, media_time: mediaTime, state: neutralFrame() });
      player.update(0.016);
      FakeSocket.last.give({ type: 'sound', media_time: mediaTime, packet });
    };
    say(1, 50_000);
    expect([Device.one.played.length, Device.one.stopped]).toEqual([1, 0]);
    FakeSocket.last.drop();
    say(1, 50_060);
    expect([Device.one.played.length, Device.one.stopped]).toEqual([2, 0]);
    FakeSocket.last.drop();
    say(2, 7);
    expect([Device.one.played.length, Device.one.stopped]).toEqual([3, 2]);
    await sound.stop();
    expect(Device.one.stopped).toBe(3);
    expect(sound.mediaTime).toBeNaN();
    client.dispose();
  });

  it('Packets_BeforeTheTap_AreNotDecoded', () => {
    const client = new StreamClient('ws://x', {
      WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>,
      now: () => world.now,
      sound: true,
    });
    const sound = new StreamSound(client, new Player(poses, { now: () => world.now }));
    const played = Device.one.played.length;
    client.connect();
    FakeSocket.last.accept();
    FakeSocket.last.give(headerOf({ epoch: 1, sound: track }));
    FakeSocket.last.give({ type: 'sound', media_time: 10, packet });
    expect(sound.isOn).toBe(false);
    expect(sound.mediaTime).toBeNaN();
    expect(Device.one.played.length).toBe(played);
    client.dispose();
  });
});

describe('StreamClient with sound', () => {
  it('Hello_AsksForSound_OnlyWhenItIsWished', () => {
    for (const wished of [true, false]) {
      const client = new StreamClient('ws://x', { WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>, sound: wished });
      client.connect();
      FakeSocket.last.accept();
      expect(FakeSocket.last.sent[0]).toMatchObject({ type: 'hello', sound: wished });
      FakeSocket.last.give(headerOf({ epoch: 1, sound: wished ? track : null }));
      expect(client.header!.sound).toEqual(wished ? track : null);
      client.dispose();
    }
  });
});

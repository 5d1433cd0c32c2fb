import { afterEach, beforeAll, describe, expect, it, vi } from 'vitest';
import { Player, StreamClient, type PoseMaker, type StreamOptions } from '../../../../clients/js/index.ts';
import { SoundSchedule, StreamSound } from '../../../../clients/js/sound/index.ts';
import { neutralFrame, opusPacketMs, type Header, type Message, type Ping } from '../../../../protocol/ts/index.ts';
import { FakeSocket, headerOf } from '../support/fake_socket.ts';
import { loadRuntime } from '../support/runtime.ts';

beforeAll(loadRuntime);
afterEach(() => void vi.useRealTimers());

/** One frame of 60 ms. */
const packet = Uint8Array.of(0x18, 1, 2, 3);

describe('SoundSchedule', () => {
  const place = (schedule: SoundSchedule, mediaTime: number, now: number, shown: number): number =>
    schedule.place({ mediaTime, duration: 60 }, now, shown)?.at ?? NaN;

  it('Packets_WithoutAGap_AreHeardWithoutAGap', () => {
    const schedule = new SoundSchedule();
    expect(place(schedule, 1000, 500, 900)).toBe(600);
    expect(place(schedule, 1060, 570, 980)).toBe(660); // the face's time has jittered; the sound hardly does
    expect(schedule.heardAt(599)).toBeNaN();
    expect(schedule.heardAt(600)).toBe(1000);
    expect(schedule.heardAt(719)).toBeCloseTo(1119, 1);
    expect(schedule.heardAt(721)).toBeNaN();
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

  it('SoundOnAnotherClock_IsBroughtBackToTheFace_ByWholeSamples_WithoutAGap', () => {
    const schedule = new SoundSchedule();
    let end = NaN;
    for (let media = 0; media < 60_000; media += 60) {
      const now = media * 0.9998; // the output is slow
      const placed = schedule.place({ mediaTime: media, duration: 60 }, now, media - 100)!;
      if (media > 0) expect(placed.at).toBeCloseTo(end, 6);
      expect(Math.abs(placed.samples - 2880)).toBeLessThanOrEqual(2);
      end = placed.at + placed.samples / 48;
      expect(Math.abs(placed.at - (now + 100))).toBeLessThan(5);
    }
  });

  it('SoundThatIsFarAheadOfTheFace_WaitsForIt', () => {
    const schedule = new SoundSchedule();
    place(schedule, 0, 0, -100);
    let media = 60;
    // The frames are later than they were by 200 ms; their face cannot follow.
    while (media < 2000 && place(schedule, media, media, media - 300) < media + 299) media += 60;
    expect(media).toBeLessThan(500);
  });
});

/** A device for sound whose clock the test moves. What is heard, and when, is read from what it was told to play. */
class Device {
  state = 'running';
  sampleRate = 48_000;
  fast = 50e-6;
  /** Within what was said without a pause. */
  gaps = 0;
  started = 0;
  stopped = 0;
  suspend = async (): Promise<void> => undefined;
  baseLatency = 0;
  outputLatency = 0.02;
  destination = null;
  createGain = (): { connect(): void } => ({ connect: () => undefined });
  readonly played: { at: number; mediaTime: number; duration: number }[] = [];
  static one: Device;
  constructor() {
    Device.one = this;
  }
  get currentTime(): number {
    return (world.now - 1000) * (1 + this.fast) * 1e-3;
  }
  resume = async (): Promise<void> => undefined;
  close = async (): Promise<void> => undefined;
  /** NaN: silence */
  get heard(): number {
    const now = (this.currentTime - this.outputLatency) * 1000;
    while (this.played[1] && now >= this.played[1].at * 1000 - 20) this.played.shift();
    const [heard] = this.played;
    const since = heard ? now - (heard.at * 1000 - 20) : NaN;
    return heard && since >= 0 && since < heard.duration ? heard.mediaTime + (since * 60) / heard.duration : NaN;
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
  private first = NaN;
  private samples = 0;
  decode({ timestamp, data }: { timestamp: number; data: Uint8Array }): void {
    decoding = timestamp / 1000;
    if (Number.isNaN(this.first)) this.first = timestamp;
    const counted = this.first + this.samples / 0.048; // as Chromium does
    this.samples += opusPacketMs(data)! * 48;
    this.given.output({
      timestamp: counted,
      numberOfFrames: opusPacketMs(data)! * 48,
      numberOfChannels: 1,
      sampleRate: 48_000,
      copyTo: () => undefined,
      close: () => undefined,
    });
  }
  flush = async (): Promise<void> => undefined;
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
    const { context } = this;
    expect(at).toBeGreaterThanOrEqual(context.currentTime);
    const last = context.played.at(-1);
    const gap = last ? at - (last.at + last.duration / 1000) : 0;
    if (gap < -1e-6) throw new Error('two packets at once');
    if (last && decoding - last.mediaTime <= 60 && gap > 1e-6) context.gaps += 1;
    context.played.push({ at, mediaTime: decoding, duration: this.given.buffer.length / 48 });
    context.started += 1;
  }
  stop(): void {
    this.context.played.length = 0;
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
  getChannelData = (): Float32Array => new Float32Array(this.length);
});
vi.stubGlobal('AudioBufferSourceNode', Source);

const poses: PoseMaker = { evaluateAt: () => undefined, interpolate: () => undefined };
const track = { codec: 'opus' as const, rate: 48_000, channels: 1, bitrate: 20_000 };

interface World {
  /** ms by which each message is late, at most, evenly */
  jitter: number;
  seconds: number;
  /** ms of the simulation; a display frame is at least 16 ms */
  step?: number;
  /** ms from one message of frames to the next */
  batch?: number;
  /** ms; nothing arrives for 350 ms from then on */
  stall?: number;
  /** ms; the connection is lost for 1200 ms */
  breaks?: number;
  /** ms; from then on each message is later by 150 ms */
  slower?: number;
  /** Without pauses between phrases. */
  endless?: boolean;
  /** How much faster than the stream's clock that of the device runs, and the client's own. */
  device?: number;
  client?: number;
}

/**
 * A face that talks and a client that joins in the middle, over a network as of a TCP connection: in order, each message late by
 * `jitter` at most, stalled and broken at times. Media time is `now` of the world.
 */
async function watch({ jitter, seconds, step = 4, batch = 40, stall, breaks, slower = Infinity, endless = false, device = 50e-6, client: ownClock = 0 }: World) {
  world.now = 10_000;
  const clientNow = (): number => world.now * (1 + ownClock);
  const client = new StreamClient('ws://x', {
    WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>,
    now: clientNow,
    sound: true,
  });
  const player: Player = new Player(poses, { now: clientNow, clock: () => sound.mediaTime });
  const sound: StreamSound = new StreamSound(client, player);
  player.follow(client);
  await sound.start();
  Device.one.fast = device;

  let seed = 7;
  const random = (): number => (seed = (seed * 48271) % 0x7fffffff) / 0x7fffffff;
  let sequence = 0;
  let socket: FakeSocket | null = null;
  let open = false;
  let onTheWay: { at: number; message: Message }[] = [];
  let frames: number[] = [];
  let read = 0;
  let pings: { at: number; ping: Ping }[] = [];
  const begin = world.now;
  const send = (message: Message): void => {
    if (!open) return;
    const held = stall !== undefined && world.now >= begin + stall && world.now < begin + stall + 350;
    const sent = (held ? begin + stall + 350 : world.now) + 20 + random() * jitter + (world.now >= begin + slower ? 150 : 0);
    onTheWay.push({ at: Math.max(onTheWay.at(-1)?.at ?? 0, sent), message });
  };
  const header = (): Header => headerOf({ epoch: 1, sequence, media_time: world.now, fps_hint: 25, batch_interval: batch, sound: track });
  const face = (): Message => ({ type: 'keyframe', sequence, media_time: world.now, state: neutralFrame() });
  const connect = (): void => {
    client.connect();
    socket = FakeSocket.last;
    socket.accept();
    open = true;
    onTheWay = [];
    frames = [];
    read = 0;
    pings = [];
    send(header());
    send(face());
  };
  const skews: number[] = [];
  let drift = 0;
  vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout'] });
  const display = Math.max(16, step);
  for (let at = 0; at < seconds * 1000; at += step) {
    world.now = begin + at;
    if (at % 60_000 === 0) await new Promise(setImmediate); // the runner asks for signs of life
    vi.advanceTimersByTime(step);
    if (at === 400) connect();
    if (at === breaks) {
      open = false;
      onTheWay = [];
      socket!.drop();
    }
    if (breaks !== undefined && at === breaks + 1200) connect();
    for (const message of FakeSocket.last?.sent.slice(read) ?? []) {
      read += 1;
      if (message.type === 'ping') pings.push({ at: world.now + 20, ping: message });
    }
    while (pings[0] && pings[0].at <= world.now) {
      const { id, client_time } = pings.shift()!.ping;
      send({ type: 'pong', id, client_time, server_time: 0, media_time: world.now });
    }
    // Phrases of 1.8 s with pauses of 360 ms.
    if (at % 60 === 0 && (endless || at % 2160 < 1800)) send({ type: 'sound', media_time: world.now, packet });
    if (at % 40 === 0) frames.push(world.now);
    if (at % batch === 0 && frames.length > 0) {
      send({ type: 'frames', sequence: sequence + 1, media_time: frames[0]!, frames: frames.map((time) => ({ time: time - frames[0]!, state: neutralFrame() })) });
      sequence += frames.length;
      frames = [];
    }
    while (onTheWay[0] && onTheWay[0].at <= world.now) socket!.give(onTheWay.shift()!.message);
    if (at % display !== 0) continue;
    player.update(display / 1000);
    const { heard } = Device.one;
    if (Number.isNaN(heard)) continue;
    skews.push(Math.abs(player.playhead - heard));
    if (at > 60_000) drift = Math.max(drift, Math.abs(world.now - heard - player.delay));
  }
  client.dispose();
  skews.sort((a, b) => a - b);
  const quantile = (share: number): number => skews[Math.floor((skews.length - 1) * share)]!;
  return { p50: quantile(0.5), p99: quantile(0.99), most: quantile(1), heard: (skews.length * display) / (seconds * 1000), drift, gaps: Device.one.gaps };
}

describe('StreamSound', () => {
  it.each([
    { name: 'a quiet network', jitter: 5, heard: 0.78 },
    { name: 'jitter', jitter: 120, heard: 0.78 },
    { name: 'a stall', jitter: 40, stall: 20_000, heard: 0.76 },
    { name: 'a lost connection', jitter: 40, breaks: 20_000, heard: 0.7 },
    { name: 'large batches', jitter: 40, batch: 200, heard: 0.78 },
    { name: 'large batches, jitter', jitter: 150, batch: 120, heard: 0.78 },
    { name: 'a network that gets slower', jitter: 40, batch: 120, slower: 20_000, heard: 0.76 },
    { name: 'endless talk, a network that gets slower', jitter: 40, batch: 120, slower: 20_000, endless: true, heard: 0.95 },
    { name: 'endless talk, a stall', jitter: 40, batch: 120, stall: 20_000, endless: true, heard: 0.95 },
  ])('Skew_OfSoundAndFace_IsBelow40ms: $name', async ({ heard, ...given }) => {
    const measured = await watch({ seconds: 40, ...given });
    expect(measured.p99).toBeLessThanOrEqual(40);
    expect(measured.heard).toBeGreaterThan(heard);
  });

  it.each([
    { device: -200e-6, client: 0 },
    { device: 300e-6, client: -200e-6 },
  ])('AnHourOfTalk_WithoutAPause_OnOtherClocks_StaysWithTheStream: $device, $client', async (clocks) => {
    const measured = await watch({ jitter: 20, seconds: 3600, step: 20, endless: true, ...clocks });
    expect(measured.drift).toBeLessThanOrEqual(20);
    expect(measured.p99).toBeLessThanOrEqual(40);
    expect(measured.gaps).toBe(0);
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
    expect([Device.one.started, Device.one.stopped]).toEqual([1, 0]);
    FakeSocket.last.drop();
    say(1, 50_060);
    expect([Device.one.started, Device.one.stopped]).toEqual([2, 0]);
    FakeSocket.last.drop();
    say(2, 7);
    expect([Device.one.started, Device.one.stopped]).toEqual([3, 2]);
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
    const played = Device.one.started;
    client.connect();
    FakeSocket.last.accept();
    FakeSocket.last.give(headerOf({ epoch: 1, sound: track }));
    FakeSocket.last.give({ type: 'sound', media_time: 10, packet });
    expect(sound.isOn).toBe(false);
    expect(sound.mediaTime).toBeNaN();
    expect(Device.one.started).toBe(played);
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

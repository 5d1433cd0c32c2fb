import { beforeAll, beforeEach, describe, expect, it, vi } from 'vitest';
import { Player, StreamClient, type PoseMaker, type StreamOptions } from '../../../../clients/js/index.ts';
import { loadUnpacking } from '../../../../clients/js/speech/library.ts';
import { StreamSpeech, voiceFor } from '../../../../clients/js/speech/stream_speech.ts';
import { isScoreOf, neutralFrame, wordsOf, wordTimes, type Message, type SpeechText, type Spoken } from '../../../../protocol/ts/index.ts';
import { FakeSocket, headerOf } from '../support/fake_socket.ts';
import { loadRuntime, loadSpeakers } from '../support/runtime.ts';
import { fromHex, vectorJson } from '../protocol/vectors.ts';

beforeAll(loadRuntime);

/** "Am pe": a for 120 ms, m for 60; p for 60, e for 120. */
const score = Uint8Array.of(0xab, 0x11, 0x19, 0xb3);
const text = (given: Partial<SpeechText> = {}): SpeechText => ({ type: 'text', speech: 1, media_time: 10_000, language: 'en', text: 'Am pe', score, ...given });

class Utterance {
  onstart: (() => void) | null = null;
  onend: (() => void) | null = null;
  onerror: ((event: { error: string }) => void) | null = null;
  onboundary: ((event: { name: string; charIndex: number }) => void) | null = null;
  voice: SpeechSynthesisVoice | null = null;
  lang = '';
  rate = 1;
  constructor(readonly text: string) {}
}
vi.stubGlobal('SpeechSynthesisUtterance', Utterance);

/** The browser's voices, told by the test what happens. */
class Voices {
  said: Utterance[] = [];
  cancelled = 0;
  constructor(public voices = [voiceOf('en-GB')]) {}
  getVoices = (): SpeechSynthesisVoice[] => this.voices;
  speak = (utterance: Utterance): void => void this.said.push(utterance);
  cancel = (): void => void (this.cancelled += 1);
  addEventListener = (): void => undefined;
  get last(): Utterance {
    return this.said.at(-1)!;
  }
}

function voiceOf(lang: string, given: Partial<SpeechSynthesisVoice> = {}): SpeechSynthesisVoice {
  return { lang, name: lang, voiceURI: lang, default: false, localService: true, ...given };
}

const poses: PoseMaker = { evaluateAt: () => undefined, interpolate: () => undefined };

async function begin(voices: Voices | undefined = new Voices()) {
  const client = new StreamClient('ws://x', {
    WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>,
    now: () => Date.now(),
    pingInterval: 0,
  });
  const speech = new StreamSpeech(client, () => 0, voices as unknown as SpeechSynthesis, () => Date.now(), loadSpeakers);
  const shown: number[] = [];
  const player = new Player(
    { ...poses, evaluateAt: (runtime, frame, pose) => pose === 0 && shown.push(runtime.bytes[frame + (runtime.bytes[frame + 2]! >= 32 ? 0 : 1)]!) },
    { now: () => Date.now(), overlay: (runtime, frame) => speech.show(runtime, frame) },
  );
  player.follow(client);
  client.connect();
  greet(9, 10_000);
  const started = await speech.start();
  const give = (message: Message): void => FakeSocket.last.give(message);
  const told = (): Spoken[] => FakeSocket.last.sent.splice(0).filter((one): one is Spoken => one.type === 'spoken');
  /** The viseme that is shown now; null: the stream's own frame. */
  const mouth = (): number | null => {
    shown.length = 0;
    player.update(0.016);
    return shown.at(-1) ?? null;
  };
  return { client, speech, voices: voices!, started, give, told, mouth };
}

function greet(epoch: number, mediaTime: number): void {
  FakeSocket.last.accept();
  FakeSocket.last.give(headerOf({ epoch, media_time: mediaTime }));
  FakeSocket.last.give({ type: 'keyframe', sequence: 1, media_time: mediaTime, state: neutralFrame() });
}

beforeEach(() => {
  vi.useFakeTimers({ now: 50_000 });
});

describe('captions', () => {
  it('Are asked for by the hello and changed later, and bring texts beside frames', async () => {
    const client = new StreamClient('ws://x', {
      WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']>,
      now: () => Date.now(),
      pingInterval: 0,
      captions: true,
    });
    const told: string[] = [];
    client.on('text', ({ text: words }) => told.push(words));
    client.connect();
    greet(9, 10_000);
    expect(FakeSocket.last.sent.splice(0)).toMatchObject([{ type: 'hello', captions: true, text: false }]);
    FakeSocket.last.give(text());
    expect(told).toEqual(['Am pe']);
    client.setCaptions(false);
    expect(FakeSocket.last.sent.splice(0)).toMatchObject([{ type: 'captions', on: false }]);
    FakeSocket.last.give(text({ speech: 2 }));
    expect(told).toHaveLength(1);
    client.dispose();
  });
});

describe('a score', () => {
  it('has the words of its text, with their times', () => {
    expect(wordTimes(score)).toEqual([0, 180]);
    expect(wordTimes(Uint8Array.of(0xf1, 63, 0x0f, 0x0f))).toEqual([0, 240]);
    expect(wordsOf(' Am\tpe 😀!\n')).toEqual([{ begin: 1, end: 3 }, { begin: 4, end: 6 }, { begin: 7, end: 10 }]);
    expect(isScoreOf(score, 'Am pe')).toBe(true);
    expect(isScoreOf(score, 'Ampe')).toBe(false);
    expect(isScoreOf(Uint8Array.of(0xf8), '')).toBe(false);
  });
});

describe('StreamSpeech', () => {
  it('Text_IsSaidAtItsTime_AndTheFaceFollowsTheVoice', async () => {
    const { give, voices, told, mouth, started } = await begin();
    expect(started).toBe(true);
    expect(told()).toEqual([{ type: 'spoken', state: 'ready', speech: 0, character: 0, media_time: 10_000 }]);
    give(text({ media_time: 10_500 }));
    await vi.advanceTimersByTimeAsync(490);
    expect(voices.said).toHaveLength(0);
    await vi.advanceTimersByTimeAsync(20);
    expect(voices.last.text).toBe('Am pe');
    expect(voices.last.voice!.lang).toBe('en-GB');
    expect(mouth()).toBeNull(); // it has not begun

    await vi.advanceTimersByTimeAsync(200);
    voices.last.onstart!();
    voices.last.onboundary!({ name: 'word', charIndex: 0 });
    expect(told()).toMatchObject([{ state: 'reached', speech: 1, character: 0 }]);
    await vi.advanceTimersByTimeAsync(60);
    expect(mouth()).toBe(10);
    await vi.advanceTimersByTimeAsync(300); // a slow voice: its second word has not begun
    mouth();
    await vi.advanceTimersByTimeAsync(16);
    expect(mouth()).toBe(1);
    voices.last.onboundary!({ name: 'word', charIndex: 3 });
    expect(told()).toEqual([]); // once a second is enough
    await vi.advanceTimersByTimeAsync(150);
    mouth();
    await vi.advanceTimersByTimeAsync(10);
    expect(mouth()).toBe(11);
    voices.last.onend!();
    expect(told()).toMatchObject([{ state: 'ended', speech: 1, character: 5 }]);
    await vi.advanceTimersByTimeAsync(400);
    mouth();
    expect(mouth()).toBeNull(); // the stream's own face again
  });

  it('Texts_AreSaidOneAfterAnother', async () => {
    const { give, voices } = await begin();
    give(text());
    give(text({ speech: 2, media_time: 10_100 }));
    await vi.advanceTimersByTimeAsync(5);
    voices.last.onstart!();
    await vi.advanceTimersByTimeAsync(1000);
    expect(voices.said).toHaveLength(1);
    voices.last.onend!();
    await vi.advanceTimersByTimeAsync(5);
    expect(voices.said).toHaveLength(2);
  });

  it('SlowVoice_IsAskedToSpeakFaster', async () => {
    const { give, voices } = await begin();
    const long = Uint8Array.of(0x9f, 0x97, 0x97, 0x97); // 960 ms
    give(text({ text: 'a', score: long }));
    give(text({ speech: 2, text: 'a', score: long, media_time: 10_960 }));
    await vi.advanceTimersByTimeAsync(1);
    voices.last.onstart!();
    await vi.advanceTimersByTimeAsync(1248);
    voices.last.onend!();
    await vi.advanceTimersByTimeAsync(1);
    expect(voices.last.rate).toBeCloseTo(1.3, 2);
  });

  it('PackedTexts_AreThoseOfTheirVectors_AndKeepTheirOrder', async () => {
    const { messages } = vectorJson('packed_text.json') as { messages: { binary: string; json: { text: string; score: string; media_time: number } }[] };
    const { client, give } = await begin();
    const seen: string[] = [];
    client.on('text', ({ text, score }) => seen.push(`${text} ${btoa(String.fromCharCode(...score))}`));
    client.on('frames', () => seen.push('frames'));
    const raw = (hex: string): void => FakeSocket.last.giveRaw(fromHex(hex).slice().buffer as ArrayBuffer);
    void loadUnpacking(loadSpeakers);
    for (const { binary } of messages) raw(binary); // before the part that unpacks them is there
    give({ type: 'frames', sequence: 2, media_time: 10_040, frames: [{ time: 0, state: neutralFrame() }] });
    await loadUnpacking(loadSpeakers);
    await vi.advanceTimersByTimeAsync(1);
    raw(messages[0]!.binary);
    const said = messages.map(({ json }) => `${json.text} ${json.score}`);
    expect(seen).toEqual([...said, 'frames', said[0]]);
  });

  it('BytesThatAreNoPackedText_AreAFault', async () => {
    const { client } = await begin();
    await loadUnpacking(loadSpeakers);
    const faults: unknown[] = [];
    client.on('fault', (fault) => faults.push(fault));
    FakeSocket.last.giveRaw(Uint8Array.of(13, 1, 1, 255, 255, 255, 255).buffer);
    await vi.advanceTimersByTimeAsync(1);
    expect(faults).toHaveLength(1);
    client.close();
  });

  it('EmptyText_Silences', async () => {
    const { give, voices, told } = await begin();
    give(text());
    give(text({ speech: 2, media_time: 11_000 }));
    await vi.advanceTimersByTimeAsync(5);
    voices.last.onstart!();
    give(text({ speech: 3, text: '', score: new Uint8Array(0) }));
    expect(voices.cancelled).toBe(1);
    await vi.advanceTimersByTimeAsync(3000);
    expect(voices.said).toHaveLength(1);
    expect(told().map(({ state }) => state)).toEqual(['ready']);
  });

  it('LateJoin_BeginsWithAWordThatIsStillToCome', async () => {
    const { give, voices, mouth } = await begin();
    const words = Uint8Array.of(0xaf, 0xa7, 0xa7, 0xa7, 0xbf, 0xb7); // the second at 960 ms
    give(text({ media_time: 9_200, text: 'one two', score: words }));
    await vi.advanceTimersByTimeAsync(150);
    expect(voices.said).toHaveLength(0);
    await vi.advanceTimersByTimeAsync(20);
    expect(voices.last.text).toBe('two');
    voices.last.onstart!();
    voices.last.onboundary!({ name: 'word', charIndex: 0 });
    await vi.advanceTimersByTimeAsync(60);
    expect(mouth()).toBe(11);
    give(text({ speech: 2, media_time: 1000 }));
    voices.last.onend!();
    await vi.advanceTimersByTimeAsync(2000);
    expect(voices.said).toHaveLength(1); // all of the other one was over
  });

  it('NewConnection_GoesOnWithWhatItKnows_AnotherEpochDoesNot', async () => {
    const { client, give, voices } = await begin();
    give(text());
    await vi.advanceTimersByTimeAsync(5);
    voices.last.onstart!();
    FakeSocket.last.drop();
    client.connect();
    greet(9, 10_050);
    const hello = FakeSocket.last.sent[0]!;
    expect(hello).toMatchObject({ type: 'hello', text: true });
    give(text());
    expect(voices.cancelled).toBe(0);
    FakeSocket.last.drop();
    client.connect();
    greet(10, 0);
    expect(voices.cancelled).toBe(1);
    give(text({ media_time: 0 }));
    await vi.advanceTimersByTimeAsync(50);
    expect(voices.said).toHaveLength(2);
  });

  it.each([
    ['has no voice of the language', (voices: Voices) => void (voices.voices = [voiceOf('pt-BR')])],
    ['does not begin', () => undefined],
    ['breaks', (voices: Voices) => setTimeout(() => voices.last.onerror!({ error: 'synthesis-failed' }), 100)],
    ['never ends', (voices: Voices) => setTimeout(() => voices.last.onstart!(), 100)],
  ])('BrowserThat_%s_GetsFrames', async (_, happens) => {
    const { client, give, speech, voices, told } = await begin();
    told();
    happens(voices);
    give(text());
    await vi.advanceTimersByTimeAsync(20_000);
    expect(speech.state).toBe('failed');
    expect(told()).toMatchObject([{ state: 'failed' }]);
    FakeSocket.last.drop();
    client.connect();
    greet(9, 30_000);
    expect(FakeSocket.last.sent[0]).toMatchObject({ type: 'hello', text: false });
  });

  it('BrowserWithoutVoices_AsksForNoText', async () => {
    const client = new StreamClient('ws://x', { WebSocket: FakeSocket as unknown as NonNullable<StreamOptions['WebSocket']> });
    for (const synthesis of [undefined, new Voices([])]) {
      const speech = new StreamSpeech(client, () => 0, synthesis as unknown as SpeechSynthesis, undefined, loadSpeakers);
      const started = speech.start();
      await vi.advanceTimersByTimeAsync(2000);
      expect(await started).toBe(false);
      expect(speech.state).toBe('failed');
    }
  });

  it('Stop_BringsFramesAndSilence', async () => {
    const { give, speech, voices, told } = await begin();
    give(text());
    await vi.advanceTimersByTimeAsync(5);
    voices.last.onstart!();
    told();
    speech.stop();
    expect(voices.cancelled).toBe(1);
    expect(told()).toMatchObject([{ state: 'failed' }]);
    expect(speech.state).toBe('off');
  });

  it('VoiceFor_PrefersTheRegionAndThisDevice', () => {
    const voices = [voiceOf('en-US', { default: true }), voiceOf('pt_PT'), voiceOf('pt-BR', { localService: false }), voiceOf('pt-BR')];
    expect(voiceFor(voices, 'pt-BR')).toBe(voices[3]);
    expect(voiceFor(voices, 'pt-AO')).toBe(voices[1]);
    expect(voiceFor(voices, 'en')).toBe(voices[0]);
    expect(voiceFor(voices, 'de')).toBeNull();
    expect(voiceFor(voices, '')).toBe(voices[0]);
    expect(voiceFor([], 'en')).toBeNull();
  });
});

/** A voice that says each word at a pace of its own, and tells it so late, ms. */
interface KnownVoice {
  /** Of the length that the score has. */
  pace: number;
  late: number;
}

/**
 * Has such a voice say 40 words of one to four sounds, looks every 10 ms at the mouth and at the sound that the voice says then, and
 * gives the lag at which most of them are the same, ms (positive: the mouth is late), that share, and the lags of the words' beginnings.
 */
async function mouthBesideVoice({ pace, late }: KnownVoice): Promise<{ lag: number; same: number; begins: number[] }> {
  let seed = 7;
  const random = (): number => (seed = (seed * 16_807) % 2_147_483_647) / 2_147_483_647;
  const words = Array.from({ length: 40 }, () => Array.from({ length: 1 + Math.floor(4 * random()) }, () => ({ viseme: 1 + Math.floor(14 * random()), units: 2 + Math.floor(3 * random()) })));
  const bytes = words.flatMap((word) => word.map(({ viseme, units }, i) => viseme * 16 + (i === 0 ? 8 : 0) + units - 1));
  const { give, voices, mouth } = await begin();
  give(text({ text: words.map(() => 'w').join(' '), score: Uint8Array.from(bytes) }));
  await vi.advanceTimersByTimeAsync(5);
  voices.last.onstart!();
  // What the voice says when, by the steps of the score at the pace of each word.
  let clock = 0;
  const said = words.map((word) => {
    const own = pace * (0.85 + 0.3 * random());
    const begins = clock;
    const sounds = word.map(({ viseme, units }) => ({ viseme, until: (clock += 30 * units * own) }));
    return { begins, sounds };
  });
  const sounds = said.flatMap((word) => word.sounds);
  const truth: number[] = [];
  const shown: (number | null)[] = [];
  for (let now = 0, told = 0; now < clock; now += 10) {
    for (; told < said.length && said[told]!.begins + late <= now; told += 1) voices.last.onboundary!({ name: 'word', charIndex: 2 * told });
    truth.push(sounds.find(({ until }) => now < until)!.viseme);
    shown.push(mouth());
    await vi.advanceTimersByTimeAsync(10);
  }
  const sameAt = (lag: number): number => truth.filter((viseme, n) => shown[n + lag / 10] === viseme).length / truth.length;
  const lags = Array.from({ length: 41 }, (_, n) => 10 * n - 200);
  const lag = lags.reduce((best, one) => (sameAt(one) > sameAt(best) ? one : best));
  const begins = said.slice(1).flatMap(({ begins: at, sounds: [first] }, i) => {
    if (said[i]!.sounds.at(-1)!.viseme === first!.viseme) return [];
    const found = shown.findIndex((viseme, n) => 10 * n >= at - 60 && viseme === first!.viseme);
    return [10 * found - at];
  });
  return { lag, same: sameAt(lag), begins: begins.sort((a, b) => a - b) };
}

describe('The mouth beside a voice whose words are known', () => {
  it.each<KnownVoice>([
    { pace: 1, late: 0 },
    { pace: 0.8, late: 0 },
    { pace: 1.25, late: 0 },
    { pace: 1, late: 30 },
  ])('%o: its lag is at most 40 ms', async (voice) => {
    const { lag, same, begins } = await mouthBesideVoice(voice);
    const at = (share: number): number => begins[Math.round((begins.length - 1) * share)]!;
    console.info(`pace ${voice.pace}, words told ${voice.late} ms late: lag ${lag} ms, ${(100 * same).toFixed(0)} % of frames the same; beginnings of ${begins.length} words: median ${at(0.5).toFixed(0)}, nine in ten ${at(0.9).toFixed(0)}, most ${at(1).toFixed(0)} ms`);
    expect(Math.abs(lag)).toBeLessThanOrEqual(40);
    expect(at(0.5)).toBeLessThanOrEqual(40 + voice.late);
    expect(same).toBeGreaterThan(0.6);
  });
});

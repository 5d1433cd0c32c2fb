import { beforeEach, describe, expect, test, vi } from 'vitest';
import { neutralFrame } from '@client/index.ts';
import type { Speech, Timeline } from '../src/net/types.ts';
import { FaceDriver } from '../src/ui/stage/face_driver.ts';
import { SpeakModel, type Sound } from '../src/ui/speak/speak_model.ts';
import { wordsOf } from '../src/ui/speak/spoken_words.ts';
import { voicesOf } from '../src/ui/speak/voices_of.ts';
import { loadLibrary } from '../../tests/unit/ts/support/runtime.ts';

const timeline = {
  format: 'semblante.timeline',
  version: 1,
  duration: 900,
  sentences: [],
  words: [
    { time: 400, end: 500, first: 0, count: 3, text: 'Olá' },
    { time: 500, end: 700, first: 7, count: 5, text: 'mundo' },
  ],
  phonemes: [],
  visemes: [],
  marks: [],
} as Timeline;
/** Of a text that begins with that of `timeline`. */
const longer = {
  ...timeline,
  duration: 2000,
  words: [...timeline.words, { time: 870, end: 1200, first: 14, count: 2, text: 'Oi' }],
} as Timeline;
const document = '{"format":"semblante.performance","version":1,"cues":[{"time":0,"duration":900,"viseme":"a"}]}';

class FakeSound {
  src = '';
  currentTime = 0;
  paused = true;
  readonly listeners = new Map<string, () => void>();
  refuses = false;
  play = (): Promise<void> => {
    if (this.refuses) return Promise.reject(new Error('no sound here'));
    this.paused = false;
    return Promise.resolve();
  };
  pause = (): void => void (this.paused = true);
  load = (): void => undefined;
  removeAttribute = (name: string): void => {
    if (name === 'src') this.src = '';
  };
  addEventListener = (name: string, listener: () => void): void => void this.listeners.set(name, listener);
}

let sound: FakeSound;
let driver: FaceDriver;
let model: SpeakModel;
let removed: string[];
let recordings: string[];
let made: number;
let fails: Error | null;
/** What the next speech of a part leaves to say. */
let rest: string;
/** Lets the speeches without `part` be made. */
let whole: Promise<void>;

beforeEach(() => {
  sound = new FakeSound();
  driver = new FaceDriver(neutralFrame());
  removed = [];
  recordings = [];
  made = 0;
  fails = null;
  rest = '';
  whole = Promise.resolve();
  model = new SpeakModel(
    {
      createSpeech: async (request) => {
        if (fails) throw fails;
        const id = `s${(made += 1)}`;
        if (!request.part) await whole;
        return { id, request, text: 'Olá', rest: request.part ? rest : '', warnings: [] } as unknown as Speech;
      },
      createSpeechOfRecording: (options, file) => {
        made += 1;
        recordings.push(file.name);
        return Promise.resolve({ id: `s${made}`, request: options, text: 'Olá', rest: '', warnings: [] } as unknown as Speech);
      },
      speechTimeline: (id) => Promise.resolve(id === 's2' ? longer : timeline),
      speechPerformance: () => Promise.resolve(document),
      speechUrl: (id, file) => `/${id}/${file}`,
      deleteSpeech: (id) => {
        expect(sound.src, 'a sound that is removed while it is loaded').not.toBe(`/${id}/audio`);
        return Promise.resolve(void removed.push(id));
      },
    },
    driver,
    sound as unknown as Sound,
    loadLibrary,
  );
});
const request = { text: 'Olá', language: 'pt-BR' } as const;

describe('speak model', () => {
  test('Say_Text_IsHeardAndSeenOnOneClock', async () => {
    await model.say(request);
    expect(sound.src).toBe('/s1/audio');
    expect(sound.paused).toBe(false);
    expect([driver.source.value, model.playing.value]).toEqual(['speech', true]);
    sound.currentTime = 0.25;
    expect(model.position).toBe(250);
    sound.listeners.get('ended')!();
    expect([driver.source.value, model.playing.value]).toEqual(['hand', false]);
    await model.play();
    expect([sound.currentTime, model.playing.value]).toEqual([0, true]);
  });

  test('SayRecording_PlaysTheFileOfTheSpeech', async () => {
    const file = new File(['RIFF'], 'me.wav');
    await model.sayRecording({ text: 'Olá', language: 'pt-BR' }, file);
    expect([recordings, sound.src, model.playing.value]).toEqual([['me.wav'], '/s1/audio', true]);
    expect(model.state.value).toMatchObject({ kind: 'ready', speech: { id: 's1' } });
  });

  test('Say_LongText_PlaysItsFirstSentences_AndGoesOnInTheWhole', async () => {
    rest = 'Oi';
    let finish = (): void => undefined;
    whole = new Promise((resolve) => (finish = resolve));
    await model.say(request);
    expect([sound.src, sound.paused, made]).toEqual(['/s1/audio', false, 2]);
    sound.currentTime = 0.9;
    sound.listeners.get('ended')!();
    expect(model.playing.value).toBe(true); // it waits for what is being made
    expect(sound.src).toBe('/s1/audio');
    finish();
    await vi.waitFor(() => expect(sound.src).toBe('/s2/audio'));
    await vi.waitFor(() => expect(sound.currentTime).toBeCloseTo(0.83)); // before the first word that was not said
    expect(removed).toEqual(['s1']);
    expect(model.state.value).toMatchObject({ kind: 'ready', speech: { id: 's2' } });
    sound.listeners.get('ended')!();
    expect([driver.source.value, model.playing.value]).toEqual(['hand', false]);
  });

  test('Say_LongText_WhoseWholeFails_SaysSoWhereItIsMissing', async () => {
    rest = 'Oi';
    whole = Promise.reject(new Error('the voice has gone'));
    whole.catch(() => undefined);
    await model.say(request);
    expect(model.playing.value).toBe(true);
    sound.listeners.get('ended')!();
    await vi.waitFor(() => expect(model.state.value).toEqual({ kind: 'failed', message: 'the voice has gone' }));
    expect(removed).toEqual(['s1']);
  });

  test('Say_NextText_WhileAWholeIsMade_LeavesNothingOnTheServer', async () => {
    rest = 'Oi';
    let finish = (): void => undefined;
    whole = new Promise((resolve) => (finish = resolve));
    await model.say(request);
    rest = '';
    const said = model.say(request);
    await Promise.resolve();
    finish();
    await said;
    expect(removed.sort()).toEqual(['s1', 's2']);
    expect(sound.src).toBe('/s3/audio');
  });

  test('AnotherSource_TakesTheFace_SilencesIt', async () => {
    await model.say(request);
    driver.byHand();
    expect([sound.paused, model.playing.value, driver.source.value]).toEqual([true, false, 'hand']);
  });

  test('Say_NextText_RemovesTheOneBefore', async () => {
    await model.say(request);
    await model.say(request);
    expect(removed).toEqual(['s1']);
    expect(sound.src).toBe('/s2/audio');
  });

  test('Say_TwoAtOnce_PlaysTheLastAlone', async () => {
    await Promise.all([model.say(request), model.say(request)]);
    expect(removed).toEqual(['s1']);
    expect(sound.src).toBe('/s2/audio');
  });

  test('Say_ServerWithoutAVoice_SaysSo', async () => {
    fails = new Error('no voice is installed on the server');
    await model.say(request);
    expect(model.state.value).toEqual({ kind: 'failed', message: 'no voice is installed on the server' });
    expect(driver.source.value).toBe('hand');
  });

  test('Say_BrowserThatPlaysNoSound_SaysSo', async () => {
    sound.refuses = true;
    await model.say(request);
    expect(model.state.value).toEqual({ kind: 'failed', message: 'no sound here' });
  });
});

describe('voices of a language', () => {
  test('VoicesOf_TagWithoutACountry_HasThoseOfAllCountries', () => {
    const voices = ['en-US', 'en-GB', 'pt-BR', 'pt-PT', 'pt', 'fr'].map((language) => ({
      voice: language,
      label: language,
      language,
      quality: 'table' as const,
    }));
    const tags = (tag: string): string[] => voicesOf(voices, tag).map(({ language }) => language);
    expect(tags('en')).toEqual(['en-US', 'en-GB']);
    expect(tags('pt-BR')).toEqual(['pt-BR', 'pt']);
    expect(tags('de')).toEqual([]);
  });
});

describe('words of a text', () => {
  test('WordsOf_TextWithSignsAndEmoji_HasEveryCharacterOnce', () => {
    const pieces = wordsOf('Olá, 😀 mundo!', timeline);
    expect(pieces).toEqual([
      { text: 'Olá', time: 400, end: 500 },
      ', 😀 ',
      { text: 'mundo', time: 500, end: 700 },
      '!',
    ]);
  });
});

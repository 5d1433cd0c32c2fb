import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { cuesOf } from '../../../../clients/js/captions/cues.ts';
import { StreamCaptions, type Cue } from '../../../../clients/js/captions/index.ts';
import { Emitter } from '../../../../clients/js/emitter.ts';
import type { StreamClient } from '../../../../clients/js/stream_client.ts';
import type { SpokenText, StreamEvents } from '../../../../clients/js/stream_types.ts';
import { wordsOf } from '../../../../protocol/ts/index.ts';

/** Each word lasts 240 ms. */
function said(text: string, given: Partial<SpokenText> = {}): SpokenText {
  const words = wordsOf(text).length;
  return { speech: 1, mediaTime: 10_000, duration: 240 * words, language: 'en', text, score: new Uint8Array(words).fill(0xaf), ...given };
}

const pangram = 'The quick brown fox jumps over the lazy dog, and the dog, which is not amused, runs after it through the whole of the long wood.';

describe('cuesOf', () => {
  it('A short sentence is one cue, which stays for a moment', () => {
    expect(cuesOf(said('Good day.'))).toEqual([{ begin: 10_000, end: 11_200, text: 'Good day.', language: 'en' }]);
    expect(cuesOf(said('Good day to you and to all of yours.'))[0]!.end).toBe(10_000 + 9 * 240 + 600);
  });

  it('A long one is divided into parts of about the same length, with the times of their words', () => {
    const cues = cuesOf(said(pangram));
    expect(cues.map(({ text }) => text).join(' ')).toBe(pangram);
    expect(cues).toHaveLength(2);
    for (const { text } of cues) expect(text.length).toBeLessThanOrEqual(74);
    expect(cuesOf(said('When it rained on us for all of the day, nobody of them wished to go out into it.')).map(({ text }) => text)[0]).toBe('When it rained on us for all of the day,');
    const before = wordsOf(cues[0]!.text).length;
    expect(cues[1]!.begin).toBe(10_000 + 240 * before);
    expect(cues[0]!.end).toBe(cues[1]!.begin);
  });

  it('Texts are divided as in WebVTT', () => {
    const vectors = JSON.parse(readFileSync(new URL('../../../golden/speech/cues.json', import.meta.url), 'utf8')) as { text: string; cues: string[] }[];
    expect(vectors.length).toBeGreaterThanOrEqual(10);
    for (const { text, cues } of vectors) expect(cuesOf(said(text)).map((cue) => cue.text)).toEqual(cues);
  });

  it('Words longer than a line, and languages without spaces, are divided too', () => {
    for (const text of ['a'.repeat(300), '你好，今天天气很好，我们一起去公园散步吧。'.repeat(6), 'สวัสดีครับวันนี้อากาศดีมากเราไปเดินเล่นกัน'.repeat(4)]) {
      const cues = cuesOf(said(text, { duration: 9000, score: Uint8Array.of(0xaf) }));
      expect(cues.length).toBeGreaterThan(1);
      expect(cues.map((cue) => cue.text).join('')).toBe(text);
      for (const [i, cue] of cues.entries()) {
        expect(cue.text.length).toBeLessThanOrEqual(74);
        expect(cue.begin).toBeGreaterThanOrEqual(i === 0 ? 10_000 : cues[i - 1]!.begin);
        expect(cue.end).toBeGreaterThan(cue.begin);
      }
    }
  });

  it('Nothing is said by nothing', () => {
    expect(cuesOf(said(''))).toEqual([]);
    expect(cuesOf(said(' \n'))).toEqual([]);
  });
});

class Client extends Emitter<StreamEvents> {
  header = { epoch: 1 };
  wishes: boolean[] = [];
  setCaptions(on: boolean): void {
    this.wishes.push(on);
  }
  give(text: SpokenText): void {
    this.emit('text', text);
  }
  begin(epoch: number): void {
    this.emit('header', { epoch } as never);
  }
  finish(): void {
    this.emit('end', { type: 'end', reason: 'finished' });
  }
}

function shows(): { client: Client; captions: StreamCaptions; at(time: number): string | null; told: (Cue | null)[] } {
  const client = new Client();
  let now = 0;
  const captions = new StreamCaptions(client as unknown as StreamClient, () => now);
  const told: (Cue | null)[] = [];
  captions.on('cue', (cue) => told.push(cue));
  captions.start();
  const at = (time: number): string | null => {
    now = time;
    captions.update();
    return captions.cue?.text ?? null;
  };
  return { client, captions, at, told };
}

describe('StreamCaptions', () => {
  it('Shows what belongs to the picture, not what has come', () => {
    const { client, at, told, captions } = shows();
    expect(client.wishes).toEqual([true]);
    client.give(said('Good day.'));
    client.give(said('How are you?', { speech: 2, mediaTime: 11_000 }));
    expect(at(9_999)).toBe(null);
    expect(at(10_000)).toBe('Good day.');
    expect(at(10_900)).toBe('Good day.');
    expect(at(11_000)).toBe('How are you?'); // replaces the first cue before its time is over
    expect(at(13_000)).toBe(null);
    expect(told.map((cue) => cue?.text ?? null)).toEqual(['Good day.', 'How are you?', null]);
    captions.stop();
    expect(client.wishes).toEqual([true, false]);
    expect(at(11_000)).toBe(null);
  });

  it('Words that were replaced do not come again when the sound begins behind the picture', () => {
    const { client, at } = shows();
    client.give(said('Good day.'));
    client.give(said('How are you?', { speech: 2, mediaTime: 11_000 }));
    expect(at(11_000)).toBe('How are you?');
    expect(at(10_800)).toBe('How are you?');
    expect(at(11_100)).toBe('How are you?');
    expect(at(8_000)).toBe(null); // another place of the stream
    expect(at(10_000)).toBe('Good day.');
  });

  it('Texts that come again after a new connection are known', () => {
    const { client, at, told } = shows();
    client.give(said('Good day.'));
    expect(at(10_100)).toBe('Good day.');
    client.begin(1);
    client.give(said('Good day.'));
    expect(at(10_200)).toBe('Good day.');
    expect(told).toHaveLength(1);
  });

  it('An end of the speech ends what is said at its time, and what would follow', () => {
    const { client, at } = shows();
    client.give(said('One two three four five six.'));
    client.give(said('Seven.', { speech: 2, mediaTime: 11_000 }));
    client.give(said('', { speech: 3, mediaTime: 10_700, duration: 0 }));
    expect(at(10_600)).toBe('One two three four five six.');
    expect(at(10_700)).toBe(null);
    expect(at(11_000)).toBe(null);
    client.give(said('Eight.', { speech: 4, mediaTime: 10_900 }));
    expect(at(10_950)).toBe('Eight.');
  });

  it('Another epoch has other texts, and an end of the stream none', () => {
    const { client, at } = shows();
    client.give(said('Old.', { speech: 7 }));
    client.begin(2);
    expect(at(10_000)).toBe(null);
    client.give(said('New.'));
    expect(at(10_000)).toBe('New.');
    client.finish();
    expect(at(10_000)).toBe(null);
  });
});

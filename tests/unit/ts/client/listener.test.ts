import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { Listener, type Heard } from '../../../../clients/js/listen/listener.ts';
import { listenPath } from '../support/runtime.ts';
import { vowel } from '../support/voice.ts';

const library = await WebAssembly.compile(readFileSync(listenPath));
const rate = 16_000;

/** 300 ms of silence, then "a", then silence. */
function spoken(): Float32Array {
  const sound = new Float32Array(rate);
  sound.set(vowel(rate, 0.4).map((value) => 0.3 * value), 0.3 * rate);
  return sound;
}

function hear(sound: Float32Array, block: number): Heard[] {
  const listener = new Listener(library, rate);
  const found: Heard[] = [];
  for (let at = 0; at < sound.length; at += block) listener.push(sound.subarray(at, at + block), (heard) => found.push(heard));
  return found;
}

const strongest = ({ weights }: Heard): number => weights.indexOf(Math.max(...weights));

describe('Listener', () => {
  it('hears a pause, a vowel and a pause, 52.5 ms behind the sound', () => {
    const heard = hear(spoken(), 128);
    expect(heard.map(({ time }) => time)).toEqual(Array.from({ length: 95 }, (_, n) => 5 + 10 * n));
    expect([20, 50, 85].map((n) => strongest(heard[n]!))).toEqual([0, 10, 0]);
    for (const { weights } of heard) expect(weights.reduce((a, b) => a + b)).toBeCloseTo(1, 5);
  });

  it('hears the same in blocks of any size', () => {
    const whole = hear(spoken(), rate);
    expect(hear(spoken(), 77)).toEqual(whole);
  });

  it('refuses a rate that is none', () => {
    expect(() => new Listener(library, 4_000)).toThrow(RangeError);
  });
});

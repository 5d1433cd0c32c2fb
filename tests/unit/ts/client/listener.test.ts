import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { Listener, type Heard } from '../../../../clients/js/listen/listener.ts';
import { listenPath } from '../support/runtime.ts';

const library = await WebAssembly.compile(readFileSync(listenPath));
const rate = 16_000;

/** 300 ms of silence, then hiss: noise whose low frequencies are taken away. */
function hiss(): Float32Array {
  const sound = new Float32Array(rate);
  let seed = 1;
  let before = 0;
  for (let n = 0.3 * rate; n < sound.length; n += 1) {
    seed = (Math.imul(seed, 1_664_525) + 1_013_904_223) | 0;
    const noise = seed / 2 ** 31;
    sound[n] = 0.1 * (noise - before);
    before = noise;
  }
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
  it('hears a pause, then a hiss, 52.5 ms behind the sound', () => {
    const heard = hear(hiss(), 128);
    expect(heard.map(({ time }) => time)).toEqual(Array.from({ length: 95 }, (_, n) => 5 + 10 * n));
    expect(strongest(heard[20]!)).toBe(0);
    expect([6, 7]).toContain(strongest(heard[60]!)); // of a hiss the lips say whether it is "s" or "sh"
    for (const { weights } of heard) expect(weights.reduce((a, b) => a + b)).toBeCloseTo(1, 5);
  });

  it('hears the same in blocks of any size', () => {
    const whole = hear(hiss(), rate);
    expect(hear(hiss(), 77)).toEqual(whole);
  });

  it('refuses a rate that is none', () => {
    expect(() => new Listener(library, 4_000)).toThrow(RangeError);
  });
});

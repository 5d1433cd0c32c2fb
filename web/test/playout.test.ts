import { describe, expect, test } from 'vitest';
import { neutralFrame } from '../src/face/frame.ts';
import { Playout, type PlayoutSample } from '../src/net/playout.ts';

const out = (): PlayoutSample => ({ from: neutralFrame(), to: neutralFrame(), share: 0 });

/** Frame n carries n in FAP 3, so that the value on display tells the media time. */
function frameOf(value: number): ReturnType<typeof neutralFrame> {
  const frame = neutralFrame();
  frame.faps[3] = value;
  return frame;
}
const shown = (s: PlayoutSample): number => s.from.faps[3]! + (s.to.faps[3]! - s.from.faps[3]!) * s.share;

describe('playout', () => {
  test('Playout_NothingArrived_ShowsNothing', () => expect(new Playout().sample(0, out())).toBe(false));

  test('Playout_OneFrame_IsShown', () => {
    const playout = new Playout();
    playout.push(0, frameOf(7), 0);
    const sample = out();
    expect(playout.sample(1, sample)).toBe(true);
    expect(shown(sample)).toBe(7);
  });

  test('Playout_SteadyStream_RunsEvenlyTwoIntervalsBehind', () => {
    const playout = new Playout();
    const sample = out();
    const rates: number[] = [];
    let before = 0;
    for (let now = 0; now < 4000; now += 8) {
      if (now % 40 === 0) playout.push(now, frameOf(now), now);
      playout.sample(now, sample);
      if (now > 2000) rates.push((shown(sample) - before) / 8);
      before = shown(sample);
    }
    expect(before).toBeGreaterThan(3992 - 120);
    expect(before).toBeLessThan(3992 - 50);
    expect(Math.min(...rates)).toBeGreaterThan(0.94);
    expect(Math.max(...rates)).toBeLessThan(1.06);
  });

  test('Playout_JitteredArrivals_NeverGoBackOrStall', () => {
    const playout = new Playout();
    const sample = out();
    let before = -Infinity;
    const late = [0, 25, 5, 30, 10, 0, 20];
    const arrivals = Array.from({ length: 120 }, (_, i) => ({ time: i * 40, at: i * 40 + late[i % late.length]! }));
    for (let now = 0; now < 4600; now += 8) {
      while (arrivals[0] && arrivals[0].at <= now) {
        const { time } = arrivals.shift()!;
        playout.push(time, frameOf(time), now);
      }
      if (!playout.sample(now, sample)) continue;
      expect(shown(sample)).toBeGreaterThanOrEqual(before);
      before = shown(sample);
    }
    expect(before).toBeGreaterThan(4300);
  });

  test('Playout_ClockGoesBack_StartsAgain', () => {
    const playout = new Playout();
    const sample = out();
    playout.push(90_000, frameOf(90_000), 0);
    playout.sample(1, sample);
    playout.push(10, frameOf(10), 40);
    playout.sample(41, sample);
    expect(shown(sample)).toBe(10);
  });

  test('Playout_LongSilence_JumpsInsteadOfCrawling', () => {
    const playout = new Playout();
    const sample = out();
    playout.push(0, frameOf(0), 0);
    playout.sample(1, sample);
    playout.push(60_000, frameOf(60_000), 60_000);
    playout.push(60_040, frameOf(60_040), 60_040);
    playout.push(60_080, frameOf(60_080), 60_080);
    playout.sample(60_081, sample);
    expect(shown(sample)).toBeGreaterThan(50_000);
  });
});

import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { Playout } from '../../../../clients/js/playout.ts';
import type { Header } from '../../../../protocol/ts/index.ts';

type TraceEvent = [string, ...number[]];
interface Trace {
  name: string;
  options: { delay?: number; eased?: boolean };
  events: TraceEvent[];
  begins: number[];
  shown: [number | null, number | null][];
  stats: Record<string, number>;
}

const traces = JSON.parse(
  readFileSync(new URL('../../../../protocol/vectors/clock/traces.json', import.meta.url), 'utf8'),
) as Trace[];

const header = (epoch: number, media_time: number, fps_hint: number, batch_interval: number): Header =>
  ({ type: 'header', epoch, media_time, fps_hint, batch_interval }) as Header;

describe('Playout', () => {
  it.each(traces)('GoldenTrace_IsShownAsTheFileSays: $name', (trace) => {
    const playout = new Playout(trace.options);
    const begins: number[] = [];
    const shown: [number, number][] = [];
    for (const [kind, now = 0, a = 0, b = 0, c = 0, d = 0, e = 0] of trace.events) {
      if (kind === 'header') {
        if (playout.begin(header(b, c, d, e))) playout.clock.clear();
        playout.clock.answered(a, now, c);
      } else if (kind === 'answer') playout.clock.answered(a, now, b);
      else if (kind === 'frames') begins.push(playout.arrived(a, b, c, now));
      else {
        playout.advance(now, a);
        shown.push([playout.playhead, playout.delay]);
      }
    }
    const far = (actual: number, expected: number | null): boolean =>
      expected === null ? !Number.isNaN(actual) : !(Math.abs(actual - expected) < 1e-5);
    expect(begins.length).toBe(trace.begins.length);
    expect(begins.findIndex((begin, i) => far(begin, trace.begins[i]!))).toBe(-1);
    expect(shown.length).toBe(trace.shown.length);
    expect(shown.findIndex((pair, i) => pair.some((value, k) => far(value, trace.shown[i]![k]!)))).toBe(-1);
    const { stats, clock } = playout;
    const actual: Record<string, number> = {
      starved: stats.starved,
      starved_time: stats.starvedTime,
      snaps: stats.snaps,
      jitter: stats.jitter,
      wanted_delay: stats.wantedDelay,
      error: stats.error,
      uncertainty: clock.uncertainty,
      drift_ppm: clock.drift * 1e6,
      steps: clock.steps,
    };
    for (const [name, value] of Object.entries(trace.stats)) expect(actual[name], name).toBeCloseTo(value, 4);
  });
});

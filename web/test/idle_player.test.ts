import { beforeAll, describe, expect, test } from 'vitest';
import { neutralFrame } from '@client/index.ts';
import { Performance, type Library } from '@client/motion/index.ts';
import { standardQuantizers } from '@protocol/quantizers.ts';
import { fineSteps } from '../src/face/fine_steps.ts';
import { loadLibrary } from '../../tests/unit/ts/support/runtime.ts';
import { clearFrame, setFap, setVisemes, shutEyes, shutLids } from '../src/face/frame.ts';
import { IdlePlayer } from '../src/face/idle_player.ts';

let library: Library;
beforeAll(async () => {
  library = await loadLibrary();
});

const settings = { seed: 5, blinksPerMinute: 20, head: 1, eyes: 1 };
const valueOf = (levels: Int16Array, fap: number): number => levels[fap]! * fineSteps[fap]!;

describe('idle life', () => {
  test('Step_OverANeutralFace_IsThatOfAPerformance', () => {
    const life = new IdlePlayer(library, neutralFrame(), settings);
    const idle = { seed: 5, blinks_per_minute: 20, head: 1, eyes: 1 };
    const performance = new Performance(library, JSON.stringify({ format: 'semblante.performance', version: 1, idle }));
    let shut = 0;
    let worst = 0; // in levels
    for (let ms = 50; ms <= 20_000; ms += 50) {
      const frame = life.step(0.05);
      const { faps } = performance.at(ms);
      for (let n = 3; n <= 68; n += 1)
        worst = Math.max(worst, Math.abs(valueOf(frame.levels, n) - faps[n]!) / fineSteps[n]!);
      if (valueOf(frame.levels, 19) > 700) shut += 1;
    }
    expect(worst).toBeLessThan(0.51);
    expect(shut).toBeGreaterThan(0);
  });

  test('Step_OverWhatIsHeld_AddsTurnsAndLetsTheRestBe', () => {
    const held = neutralFrame();
    setVisemes(held, 3, 0, 1);
    setFap(held, 3, 400, false);
    setFap(held, 49, 30_000, false);
    const before = held.levels.slice();
    const [over, alone] = [
      new IdlePlayer(library, held, settings),
      new IdlePlayer(library, neutralFrame(), settings),
    ];
    for (let i = 0; i < 100; i += 1) {
      const [frame, idle] = [over.step(0.1), alone.step(0.1)];
      expect(frame.viseme).toEqual(held.viseme);
      expect(valueOf(frame.levels, 3)).toBe(held.levels[3]! * standardQuantizers[3]!);
      const turned = held.levels[49]! * standardQuantizers[49]!;
      expect(valueOf(frame.levels, 49) - valueOf(idle.levels, 49)).toBeCloseTo(turned, 6);
    }
    expect(held.levels).toEqual(before);
    clearFrame(held);
    expect(over.step(0).levels).toEqual(alone.step(0).levels);
  });

  test('Step_EyesHeldShut_StayShut', () => {
    const held = neutralFrame();
    shutEyes(held);
    const life = new IdlePlayer(library, held, settings);
    for (let i = 0; i < 200; i += 1) expect(life.step(0.05).levels[19]).toBe(held.levels[19]);
  });

  test('ShutLids_AreWhereABlinkEnds', () => {
    const blink = { time: 0, duration: 1000, attack: 100, release: 100, blink: 'both' };
    const document = { format: 'semblante.performance', version: 1, cues: [blink] };
    const { faps } = new Performance(library, JSON.stringify(document)).at(500);
    for (const [fap, shut] of shutLids) expect(faps[fap]).toBe(shut);
  });
});

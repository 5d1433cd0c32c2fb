import { describe, expect, test } from 'vitest';
import { neutralFrame, Performance } from '@client/index.ts';
import { standardQuantizers } from '@protocol/quantizers.ts';
import { fineSteps } from '../src/face/fine_steps.ts';
import { clearFrame, setFap, setVisemes, shutEyes } from '../src/face/frame.ts';
import { IdlePlayer } from '../src/face/idle_player.ts';

const settings = { seed: 5, blinksPerMinute: 20, head: 1, eyes: 1 };
const valueOf = (levels: Int16Array, fap: number): number => levels[fap]! * fineSteps[fap]!;

describe('idle life', () => {
  test('Step_OverANeutralFace_IsThatOfAPerformance', () => {
    const life = new IdlePlayer(neutralFrame(), settings);
    const performance = new Performance({ name: '', duration: 0, idle: settings, cues: [] });
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
    const [over, alone] = [new IdlePlayer(held, settings), new IdlePlayer(neutralFrame(), settings)];
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
    const life = new IdlePlayer(held, settings);
    for (let i = 0; i < 200; i += 1) expect(life.step(0.05).levels[19]).toBe(held.levels[19]);
  });
});

import { expect, test } from 'vitest';
import type { ModelFrame } from '../src/net/types.ts';
import { quarterTurned, standsUncertain, type QuarterTurn } from '../src/ui/points/upright_box.ts';
import { importingModel } from './support/models.ts';

type Axes = ModelFrame['axes'];
const upright: Axes = { up: '+Y', front: '+Z' };
const turns: QuarterTurn[] = ['stand', 'turn', 'roll'];

test('QuarterTurns_OfAFileWithZUp_StandItUp', () => {
  expect(quarterTurned(upright, 'stand')).toEqual({ up: '+Z', front: '-Y' });
  expect(quarterTurned(upright, 'turn')).toEqual({ up: '+Y', front: '+X' });
  expect(quarterTurned(upright, 'roll')).toEqual({ up: '+X', front: '+Z' });
});

test('QuarterTurns_FourTimes_AreNone_AndTogetherReachAll24', () => {
  for (const turn of turns) {
    let axes = upright;
    for (let i = 0; i < 4; i += 1) axes = quarterTurned(axes, turn);
    expect(axes, turn).toEqual(upright);
  }
  const reached = new Map<string, Axes>([['', upright]]);
  for (const axes of reached.values())
    for (const turn of turns) {
      const next = quarterTurned(axes, turn);
      const key = `${next.up}${next.front}`;
      if (key !== '+Y+Z' && !reached.has(key)) reached.set(key, next);
    }
  expect(reached.size).toBe(24);
});

test('StandsUncertain_OnlyUntilTheFileOrThePersonTells', () => {
  const head = (sure: boolean, byUser: boolean, state: 'ready' | 'parametrized' = 'ready'): boolean =>
    standsUncertain(importingModel({ state, frame: { axes: upright, sure: { axes: sure }, by_user: { axes: byUser } } as unknown as ModelFrame }));
  expect([head(false, false), head(true, false), head(false, true), head(false, false, 'parametrized')]).toEqual([true, false, false, false]);
  expect(standsUncertain(null)).toBe(false);
});

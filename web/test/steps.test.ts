import { expect, test } from 'vitest';
import { quickSet } from '../src/face/quick_set.ts';
import { doneSteps } from '../src/ui/page/steps.ts';
import { importingModel } from './support/models.ts';

test.each([
  ['no head', null, false, [false, false, false, false]],
  ['one that is being read', importingModel({}), true, [false, false, false, false]],
  ['one without points', importingModel({ state: 'ready' }), false, [true, false, false, false]],
  ['one with too few', importingModel({ state: 'ready', feature_point_count: quickSet.length - 1 }), false, [true, false, false, false]],
  ['one with the first points', importingModel({ state: 'ready', feature_point_count: quickSet.length }), false, [true, true, false, false]],
  ['one that moves', importingModel({ state: 'parametrized' }), false, [true, true, true, false]],
  ['one that has talked', importingModel({ state: 'parametrized' }), true, [true, true, true, true]],
] as const)('DoneSteps_%s', (_, model, talked, done) => expect(doneSteps(model, talked)).toEqual(done));

import { expect, test } from 'vitest';
import { quickSet } from '../src/face/quick_set.ts';
import { stateInWords } from '../src/ui/heads/head_state.ts';
import { importingModel } from './support/models.ts';

test.each([
  [importingModel(), 'Importing'],
  [importingModel({ state: 'ready', feature_point_count: quickSet.length - 1 }), 'Needs points'],
  [importingModel({ state: 'ready', feature_point_count: quickSet.length }), 'Has points, does not move yet'],
  [importingModel({ state: 'parametrized', feature_point_count: 84 }), 'Ready to animate'],
] as const)('StateInWords_%#_SaysWhatTheHeadWaitsFor', (model, words) => expect(stateInWords(model)).toBe(words));

import { expect, test } from 'vitest';
import { fapsWithoutEffect } from '../src/ui/animate/fap_sliders.ts';
import { neutralPose } from './support/pose.ts';

test('FapsWithoutEffect_AFaceWithoutIrisesOrTongue_NamesTheirs', () => {
  const pose = neutralPose();
  expect([...fapsWithoutEffect(pose)]).toEqual([29, 30, 47]);
  pose.irises[3] = 0.1; // the left pupil's radius
  expect([...fapsWithoutEffect(pose)]).toEqual([30, 47]);
  pose.irises[9] = 0.1;
  pose.tongue[9] = 2; // half its width
  expect([...fapsWithoutEffect(pose)]).toEqual([]);
});

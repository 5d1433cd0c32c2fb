import { expect, test } from 'vitest';
import { faps } from '@protocol/generated/mpeg4.ts';
import { fapMatches, fapsWithoutEffect } from '../src/ui/animate/fap_sliders.ts';
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

test('FapMatches_NumberNameOrTitle_FindsIt', () => {
  const found = (words: string): number[] => faps.filter((fap) => fapMatches(fap, words)).map(({ number }) => number);
  expect(found('31')).toEqual([31]);
  expect(found('FAP 3')).toEqual([3]);
  expect(found(' open_jaw ')).toEqual([3]);
  expect(found('LEFT lid')).toEqual([19, 21]);
  expect(found('lid left')).toEqual([19, 21]);
  expect(found('nothing of the kind')).toEqual([]);
});

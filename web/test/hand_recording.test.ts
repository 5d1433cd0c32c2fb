import { expect, test } from 'vitest';
import { neutralFrame } from '@client/index.ts';
import { HandRecording } from '../src/face/hand_recording.ts';
import { longestMotion } from '../src/face/motion_frames.ts';

test('HandRecording_LateSamples_StandForTheFramesLeftOut', () => {
  const hand = neutralFrame();
  const recording = new HandRecording(1000);
  recording.add(1000, hand);
  hand.levels[3] = 7;
  recording.add(1015, hand); // between two frames
  recording.add(1130, hand); // the frames of 40, 80 and 120 ms
  hand.levels[3] = 9;
  recording.add(1160, hand);
  expect(recording.frames.map(({ time }) => time)).toEqual([0, 40, 80, 120, 160]);
  expect(recording.frames.map(({ state }) => state.levels[3])).toEqual([0, 7, 7, 7, 9]);
});

test('HandRecording_EndsWhenFull', () => {
  const recording = new HandRecording(0);
  recording.add(longestMotion * 2, neutralFrame());
  expect(recording.full).toBe(true);
  expect(recording.frames).toHaveLength(longestMotion / 40);
});

import { expect, test } from 'vitest';
import { MissedFrames } from '../src/net/missed_frames.ts';

test('MissedFrames_KeyframeBeyondTheNewestFrame_CountsTheFramesBetween', () => {
  const missed = new MissedFrames();
  missed.header(7);
  expect(missed.keyframe(100)).toBe(0);
  missed.frames(110);
  expect(missed.keyframe(110)).toBe(0);
  expect(missed.keyframe(135)).toBe(25);
  missed.frames(140);
  missed.header(7); // resumed: what was missed meanwhile counts
  expect(missed.keyframe(150)).toBe(35);
});

test('MissedFrames_AnotherEpoch_CountsFromItsFirstKeyframe', () => {
  const missed = new MissedFrames();
  missed.header(7);
  missed.keyframe(10);
  missed.frames(20);
  missed.header(8);
  expect(missed.keyframe(5000)).toBe(0);
  expect(missed.keyframe(5003)).toBe(3);
});

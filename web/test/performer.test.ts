import { expect, test } from 'vitest';
import { neutralFrame, type FaceFrame, type Kernel, type Pose } from '@client/index.ts';
import { Performer, poseCount } from '../src/face/performer.ts';

/** Poses of one number, the level of FAP 3. */
class NumberKernel {
  readonly poses = Array.from({ length: poseCount }, () => ({ featurePoints: new Float32Array(1) }) as unknown as Pose);
  evaluate(frame: FaceFrame, pose: number): void {
    this.poses[pose]!.featurePoints[0] = frame.levels[3]!;
  }
  interpolate(a: number, b: number, t: number, out: number): void {
    const [from, to] = [a, b].map((pose) => this.poses[pose]!.featurePoints[0]!) as [number, number];
    this.poses[out]!.featurePoints[0] = t === 1 ? to : from + (to - from) * t;
  }
}

const performerOf = (): Performer => new Performer(new NumberKernel() as unknown as Kernel);
const open = (level: number): FaceFrame => {
  const frame = neutralFrame();
  frame.levels[3] = level;
  return frame;
};

/** Pictures that are drawn of the next second, at 60 a second. */
function drawn(performer: Performer): number {
  let count = 0;
  for (let i = 0; i < 60; i += 1) if (performer.step(1 / 60, false)) count += 1;
  return count;
}

test('Performer_AnotherFrame_IsReachedInHalfASecondAndDrawnNoMore', () => {
  const performer = performerOf();
  performer.follow(open(100));
  performer.step(1 / 60, false);
  expect(performer.pose.featurePoints[0]).toBeGreaterThan(20);
  expect(performer.pose.featurePoints[0]).toBeLessThan(30); // 1 - exp(-0.0167 s / 0.055 s) = 0.26
  expect(drawn(performer)).toBeLessThan(30);
  expect(performer.pose.featurePoints[0]).toBe(100);
  expect(drawn(performer)).toBe(0);
});

test('Performer_TheFrameThatIsShown_IsDrawnOnce', () => {
  const performer = performerOf();
  performer.follow(open(0));
  expect(drawn(performer)).toBe(1);
  performer.follow(open(50));
  expect(drawn(performer)).toBeGreaterThan(20);
  performer.follow(open(50));
  expect(drawn(performer)).toBe(1);
  performer.showBetween(open(70), open(70), 0);
  performer.follow(open(70));
  expect(drawn(performer)).toBe(1);
  expect(performer.pose.featurePoints[0]).toBe(70);
});

import { expect, test } from 'vitest';
import { SpokenTime } from '../src/net/voice_encoder.ts';

/** Blocks of 10 ms whose clock begins at 0 when the page's is `began`; `late`: ms until the page has one. */
function blocks(time: SpokenTime, count: number, began: number, late: (block: number) => number, fast = 0): void {
  for (let block = 1; block <= count; block += 1) time.came(10 * block * (1 + fast), began + 10 * block + late(block));
}

test('Packet_BeginsWhenItWasSpoken_HoweverLateThePageIs', () => {
  const time = new SpokenTime();
  blocks(time, 100, 5000, (block) => (block % 7 === 0 ? 3 : 80));
  expect(time.place(940, 60)).toBeCloseTo(5943, 0);
});

test('Packets_DoNotOverlap_WhenTheEstimateGetsBetter', () => {
  const time = new SpokenTime();
  time.came(60, 5000 + 60 + 90);
  const first = time.place(0, 60);
  time.came(120, 5000 + 120 + 3);
  expect(time.place(60, 60)).toBe(first + 60);
  // After a silence the better one is used.
  time.came(1000, 5000 + 1000 + 5);
  expect(time.place(900, 60)).toBeCloseTo(5903.5, 0);
});

test('ClockThatRunsSlow_IsFollowed', () => {
  const time = new SpokenTime();
  blocks(time, 360_000, 5000, () => 3, -200e-6); // an hour
  const end = 3_600_000 * (1 - 200e-6);
  expect(Math.abs(time.place(end - 60, 60) - (5000 + 3_600_000 - 60 + 3))).toBeLessThan(20);
});

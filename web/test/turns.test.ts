import { expect, test, vi } from 'vitest';
import { ApiError } from '../src/net/problem.ts';
import { Turns } from '../src/net/turns.ts';

const busy = (retryAfter: number | null): ApiError => new ApiError({ type: '/problems/too-many-requests', title: 'busy', status: 429 }, retryAfter);

test('Turns_SendOneRequestAfterTheOther_AlsoAfterAFailure', async () => {
  const turns = new Turns();
  const sent: string[] = [];
  let end: () => void = () => undefined;
  const first = turns.take(() => {
    sent.push('first');
    return new Promise<void>((_, reject) => (end = () => reject(new Error('failed'))));
  });
  const second = turns.take(() => Promise.resolve(sent.push('second')));
  await Promise.resolve();
  expect(sent).toEqual(['first']);
  end();
  await expect(first).rejects.toThrow('failed');
  await second;
  expect(sent).toEqual(['first', 'second']);
});

test('Turns_WaitAsLongAsTheServerSays_AndGiveUpInTheEnd', async () => {
  vi.useFakeTimers();
  try {
    const turns = new Turns();
    let refusals = 2;
    let tries = 0;
    const made = turns.take(() => {
      tries += 1;
      return refusals-- > 0 ? Promise.reject(busy(1)) : Promise.resolve('made');
    });
    await vi.advanceTimersByTimeAsync(900);
    expect(tries).toBe(1);
    await vi.advanceTimersByTimeAsync(1200);
    await expect(made).resolves.toBe('made');
    expect(tries).toBe(3);

    const never = turns.take(() => Promise.reject(busy(1)));
    const told = expect(never).rejects.toThrow('busy');
    await vi.advanceTimersByTimeAsync(10_000);
    await told;
    await expect(turns.take(() => Promise.reject(busy(null)))).rejects.toThrow('busy');
  } finally {
    vi.useRealTimers();
  }
});

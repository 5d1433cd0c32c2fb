import { ApiError } from './problem.ts';

const mostTries = 5;
const pause = (seconds: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, seconds * 1000));

async function patiently<T>(request: () => Promise<T>): Promise<T> {
  for (let tries = 1; ; tries += 1) {
    try {
      return await request();
    } catch (error) {
      const wait = error instanceof ApiError && error.problem.status === 429 ? error.retryAfter : null;
      if (wait === null || tries >= mostTries) throw error;
      await pause(wait);
    }
  }
}

/**
 * Sends one request after the other: a small server lets one voice speak at a time, and refuses another with 429. That of
 * other pages is waited for, as long as the server says by Retry-After.
 */
export class Turns {
  private last: Promise<unknown> = Promise.resolve();

  take<T>(request: () => Promise<T>): Promise<T> {
    const turn = this.last.then(() => patiently(request));
    this.last = turn.catch(() => undefined);
    return turn;
  }
}

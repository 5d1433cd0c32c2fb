import { afterAll, vi } from 'vitest';

/** Files share a process: a clock that one has left standing stops what the next waits for, and the loading of modules. */
afterAll(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

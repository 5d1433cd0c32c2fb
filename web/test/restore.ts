import { afterAll, vi } from 'vitest';

/**
 * Files share a process and its modules. A clock that a file has left standing stops what the next one waits for; an import
 * that it has begun and not awaited is never answered after its end, and the next file that wants the module waits in vain.
 */
afterAll(async () => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
  await vi.dynamicImportSettled();
});

import { defineConfig } from 'vitest/config';
import { aliases, packagesForTests } from './aliases.ts';

/** The studio in headless Chromium against a real server process: slow, one at a time. */
export default defineConfig({
  resolve: { alias: [...aliases, ...packagesForTests] },
  server: { fs: { allow: ['..'] } },
  test: {
    include: ['../tests/browser/**/*.test.ts'],
    environment: 'node',
    // Each wait has a limit of its own (support/patience.ts).
    testTimeout: 3_600_000,
    hookTimeout: 3_600_000,
    fileParallelism: false,
  },
});

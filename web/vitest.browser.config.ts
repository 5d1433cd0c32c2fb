import { defineConfig } from 'vitest/config';
import { patience } from '../tests/browser/support/patience.ts';
import { aliases, packagesForTests } from './aliases.ts';

/** The studio in headless Chromium against a real server process: slow, one at a time. */
export default defineConfig({
  resolve: { alias: [...aliases, ...packagesForTests] },
  server: { fs: { allow: ['..'] } },
  cacheDir: 'node_modules/.vite-browser', // not that of the unit tests, which run at the same time
  test: {
    include: ['../tests/browser/**/*.test.ts'],
    globalSetup: ['../tests/browser/support/prepare.ts'],
    environment: 'node',
    isolate: false, // the files share a browser (support/suite.ts)
    // Each wait has a limit of its own (support/patience.ts); this ends what hangs without one, and names it.
    testTimeout: 2 * patience,
    hookTimeout: 2 * patience,
    // Two files at a time are done a fifth earlier on two processors, but tests of sound and of races then fail now and again.
    fileParallelism: false,
  },
});

import { defineConfig } from 'vitest/config';
import { aliases, packagesForTests } from './aliases.ts';

/** The studio in headless Chromium against a real server process: slow, one at a time. */
export default defineConfig({
  resolve: { alias: [...aliases, ...packagesForTests] },
  server: { fs: { allow: ['..'] } },
  test: {
    include: ['../tests/browser/**/*.test.ts'],
    environment: 'node',
    testTimeout: 300_000,
    hookTimeout: 120_000,
    fileParallelism: false,
  },
});

import { defineConfig } from 'vitest/config';
import { patience } from '../tests/browser/support/patience.ts';
import { aliases, packagesForTests } from './aliases.ts';

const named = (...names: string[]): string[] => names.map((name) => `../tests/browser/${name}.test.ts`);

/** Tests of sound, of frames in time and of what a heap keeps: another browser beside theirs disturbs what they measure. */
const measured = named('captions', 'first_load', 'frame_loop', 'live_overlay', 'microphone', 'soak', 'sound_network', 'speak', 'view_network', 'voice');

/** The studio in headless Chromium against a real server process: slow, two files at a time, then the measured ones one by one. */
export default defineConfig({
  resolve: { alias: [...aliases, ...packagesForTests] },
  server: { fs: { allow: ['..'] } },
  cacheDir: 'node_modules/.vite-browser', // not that of the unit tests, which run at the same time
  test: {
    globalSetup: ['../tests/browser/support/prepare.ts'],
    environment: 'node',
    pool: 'forks',
    isolate: false, // the files of a process share a browser (support/suite.ts)
    // Each wait has a limit of its own (support/patience.ts); this ends what hangs without one, and names it.
    testTimeout: 2 * patience,
    hookTimeout: 2 * patience,
    maxWorkers: 2,
    projects: [
      { extends: true, test: { name: 'together', include: named('*'), exclude: measured, sequence: { groupOrder: 0 } } },
      { extends: true, test: { name: 'one by one', include: measured, poolOptions: { forks: { singleFork: true } }, sequence: { groupOrder: 1 } } },
    ],
  },
});

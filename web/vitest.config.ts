import { defineConfig } from 'vitest/config';
import { aliases, packagesForTests } from './aliases.ts';

/** Unit tests: ours in test/, and those of the protocol and the JS client in ../tests/unit/ts. No browser, no server. */
export default defineConfig({
  resolve: { alias: [...aliases, ...packagesForTests] },
  server: { fs: { allow: ['..'] } },
  test: {
    include: ['test/**/*.test.ts', '../tests/unit/ts/**/*.test.ts'],
    environment: 'node',
    isolate: false, // a process for each file took three quarters of the time
    setupFiles: ['test/restore.ts'],
    // Only a hang lasts so long, on however busy a machine.
    testTimeout: 600_000,
    hookTimeout: 600_000,
  },
});

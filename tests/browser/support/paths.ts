import { existsSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = fileURLToPath(new URL('../../../', import.meta.url));
export const buildDir = resolve(process.env['SEMBLANTE_BUILD'] ?? join(root, 'build'));
export const webRoot = join(root, 'web/dist');
export const sampleHead = join(buildDir, 'sample/sample-head.glb');
export const samplePoints = join(buildDir, 'sample/sample-head.fps.json');
export const chromium = process.env['SEMBLANTE_CHROMIUM'] ?? '/usr/bin/chromium';

/** The folder of real heads, or null when it is not available. */
export const faces =
  [process.env['SEMBLANTE_FACES_DIR'], join(root, '../shared/faces')].find((dir) => dir && existsSync(dir)) ?? null;

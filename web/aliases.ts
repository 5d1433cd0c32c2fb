import { fileURLToPath } from 'node:url';

const here = (path: string): string => fileURLToPath(new URL(path, import.meta.url));

/**
 * Where imports outside web/ lead. The tests live beside this folder, where Node would find no node_modules, so the
 * packages they use are named here too.
 */
export const aliases = [
  { find: '@protocol', replacement: here('../protocol/ts') },
  { find: '@client', replacement: here('../clients/js') },
];

export const packagesForTests = [
  { find: /^vitest$/, replacement: here('node_modules/vitest/dist/index.js') },
  { find: /^axe-core$/, replacement: here('node_modules/axe-core/axe.js') },
  { find: /^draco3d$/, replacement: here('node_modules/draco3d/draco3d.js') },
  { find: /^playwright-core$/, replacement: here('node_modules/playwright-core/index.mjs') },
  { find: /^gltf-validator$/, replacement: here('node_modules/gltf-validator/module.mjs') },
  { find: /^esbuild$/, replacement: here('node_modules/esbuild/lib/main.js') },
  { find: /^vite$/, replacement: here('node_modules/vite/dist/node/index.js') },
  { find: /^three$/, replacement: here('node_modules/three/build/three.module.js') },
  { find: /^three\/addons\/(.*)$/, replacement: here('node_modules/three/examples/jsm') + '/$1' },
];

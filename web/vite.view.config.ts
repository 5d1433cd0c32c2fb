import { fileURLToPath } from 'node:url';
import { defineConfig, type Plugin } from 'vite';
import { followsLetters } from './letters.ts';
import { serviceWorker } from './service_worker.ts';

const here = (path: string): string => fileURLToPath(new URL(path, import.meta.url));

/** Lets the browser fetch the WebAssembly files beside the script instead of after it, but for that of a voice, which few ask for. */
function preloadWasm(): Plugin {
  return {
    name: 'semblante-preload-wasm',
    transformIndexHtml: {
      order: 'post',
      handler: (_, { bundle }) =>
        Object.keys(bundle ?? {})
          .filter((name) => name.endsWith('.wasm') && !name.includes('semblante_speak'))
          .map((name) => ({
            tag: 'link',
            attrs: { rel: 'preload', as: 'fetch', crossorigin: true, href: `./${name}` },
            injectTo: 'head' as const,
          })),
    },
  };
}

/** The page `/view/{stream}`, a build of its own: no code of the studio gets into it. It uses the npm package as it is packed. */
export default defineConfig({
  root: here('view'),
  base: './',
  resolve: {
    alias: [{ find: /^semblante\/(\w+)$/, replacement: `${process.env['SEMBLANTE_PACKAGE'] ?? here('../build/npm/semblante')}/dist/$1.js` }],
  },
  css: followsLetters,
  plugins: [preloadWasm(), serviceWorker(here('offline/worker/view.ts'))],
  build: {
    outDir: here('dist/view'),
    emptyOutDir: true,
    target: 'es2022',
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
  },
});

import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { defineConfig, type Plugin } from 'vite';
import { aliases } from './aliases.ts';
import { followsLetters } from './letters.ts';
import { serviceWorker } from './service_worker.ts';

const here = (path: string): string => fileURLToPath(new URL(path, import.meta.url));
const library = process.env['SEMBLANTE_WASM'] ?? here('../build/wasm');
const sample = process.env['SEMBLANTE_SAMPLE_FOLDER'] ?? here('../build/sample');
const draco = here('node_modules/three/examples/jsm/libs/draco/gltf/');

/** Files that are fetched at run time under a fixed name: the client library in its parts, the Draco decoder, and the sample head. */
const assets: Record<string, string> = {
  'semblante_view.wasm': `${library}/semblante_view.wasm`,
  'semblante_motion.wasm': `${library}/semblante_motion.wasm`,
  'semblante_listen.wasm': `${library}/semblante_listen.wasm`,
  'semblante_speak.wasm': `${library}/semblante_speak.wasm`,
  'draco/draco_wasm_wrapper.js': draco + 'draco_wasm_wrapper.js',
  'draco/draco_decoder.wasm': draco + 'draco_decoder.wasm',
  'sample/sample-head.glb': `${sample}/sample-head.glb`,
  'sample/sample-head.fps.json': `${sample}/sample-head.fps.json`,
};

function runtimeAssets(): Plugin {
  return {
    name: 'semblante-runtime-assets',
    configureServer(server) {
      server.middlewares.use((request, response, next) => {
        const name = (request.url ?? '').split('?')[0]!.replace(/^\//, '');
        if (name === 'listen_worklet.js') {
          response.writeHead(302, { Location: `/@fs${here('../clients/js/listen/worklet.ts')}` });
          return response.end();
        }
        const file = assets[name];
        if (file === undefined || !existsSync(file)) return next();
        response.setHeader('Content-Type', name.endsWith('.wasm') ? 'application/wasm' : name.endsWith('.js') ? 'text/javascript' : 'application/octet-stream');
        response.end(readFileSync(file));
      });
    },
    generateBundle() {
      for (const [fileName, file] of Object.entries(assets)) {
        if (!existsSync(file)) {
          const advice =
            file.startsWith(library)
              ? ': build the target semblante-runtime-wasm, or set SEMBLANTE_WASM to its folder'
              : file.startsWith(sample)
                ? ': run build/bin/semblante-sample-head build/sample, or set SEMBLANTE_SAMPLE_FOLDER'
                : '';
          this.error(`${fileName} is missing${advice}`);
        }
        this.emitFile({ type: 'asset', fileName, source: readFileSync(file) });
      }
    },
  };
}

const server = process.env['SEMBLANTE_SERVER'] ?? 'http://127.0.0.1:8080';

export default defineConfig({
  base: './',
  resolve: { alias: aliases, dedupe: ['three'] },
  css: followsLetters,
  plugins: [runtimeAssets(), serviceWorker(here('offline/worker/studio.ts'))],
  build: {
    target: 'es2022',
    chunkSizeWarningLimit: 1100,
    assetsInlineLimit: 0,
    rollupOptions: {
      input: { index: here('index.html'), listen_worklet: here('../clients/js/listen/worklet.ts') },
      output: {
        entryFileNames: ({ name }) => (name === 'index' ? 'assets/[name]-[hash].js' : '[name].js'),
        // A browser keeps three.js when the studio changes, and a profile tells the one from the other.
        manualChunks: (id) => (id.includes('node_modules/three/') ? 'three' : undefined),
      },
    },
  },
  server: {
    fs: { allow: ['..'] },
    proxy: {
      '/v1': { target: server, ws: true },
      '/version': { target: server },
      '/healthz': { target: server },
    },
  },
});

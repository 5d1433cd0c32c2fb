import { build } from 'esbuild';
import type { Plugin } from 'vite';

/** Builds a service worker by itself, as `worker.js`: a classic worker cannot import a chunk that it has in common with the page. */
export function serviceWorker(entry: string): Plugin {
  return {
    name: 'semblante-service-worker',
    apply: 'build',
    async generateBundle() {
      const { outputFiles } = await build({
        entryPoints: [entry],
        bundle: true,
        format: 'iife',
        minify: true,
        target: 'es2022',
        write: false,
      });
      this.emitFile({ type: 'asset', fileName: 'worker.js', source: outputFiles[0]!.contents });
    },
  };
}

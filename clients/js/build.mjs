// Makes the npm package `semblante` in build/npm/semblante, ready for `npm pack`: ES modules, declarations, WebAssembly.
//   node clients/js/build.mjs [FOLDER]
// Tools and three.js come from web/node_modules. SEMBLANTE_WASM is the folder of the library's files, SEMBLANTE_BUILD the build folder.
import { execFileSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = fileURLToPath(new URL('.', import.meta.url));
const root = resolve(here, '../..');
const tools = createRequire(join(root, 'web/package.json'));
const { build, transform } = await import(pathToFileURL(tools.resolve('esbuild')).href);

const buildFolder = resolve(process.env.SEMBLANTE_BUILD ?? join(root, 'build'));
const folder = resolve(process.argv[2] ?? join(root, 'build/npm/semblante'));
const dist = join(folder, 'dist');
const wasm = ['semblante_view.wasm', 'semblante_motion.wasm', 'semblante_listen.wasm', 'semblante_speak.wasm'].map((name) => join(process.env.SEMBLANTE_WASM ?? join(buildFolder, 'wasm'), name));
for (const file of wasm.filter((one) => !existsSync(one))) {
  console.error(`${file} is missing: build the target semblante-runtime-wasm, or set SEMBLANTE_WASM`);
  process.exit(1);
}
rmSync(folder, { recursive: true, force: true });
mkdirSync(dist, { recursive: true });

// Google's decoder is a script for pages, workers and Node that looks for its file by itself. As a module that is given
// its bytes it needs none of that: without `process` it takes no way of Node's.
const dracoFolder = join(root, 'web/node_modules/three/examples/jsm/libs/draco/gltf');
const dracoScript = readFileSync(join(dracoFolder, 'draco_wasm_wrapper.js'), 'utf8');
const dracoModule = await transform(`${dracoScript}\nexport default DracoDecoderModule;`, {
  define: Object.fromEntries(['process', 'module', 'exports', 'define', 'require', '__filename', '__dirname'].map((name) => [name, 'undefined'])),
  minify: true,
  format: 'esm',
});

await build({
  entryPoints: { index: 'npm.ts', captions: 'captions/index.ts', draco: 'draco/index.ts', element: 'element/index.ts', listen: 'listen/npm.ts', motion: 'motion/npm.ts', sound: 'sound/index.ts', speech: 'speech/index.ts', three: 'three/index.ts' },
  absWorkingDir: here,
  outdir: dist,
  bundle: true,
  splitting: true,
  format: 'esm',
  target: 'es2022',
  minify: true,
  legalComments: 'none',
  external: ['three', '*.wasm'],
  chunkNames: 'shared-[hash]',
  plugins: [
    {
      name: 'draco-decoder',
      setup({ onResolve, onLoad }) {
        onResolve({ filter: /^draco-decoder$/ }, () => ({ path: 'draco-decoder', namespace: 'draco' }));
        onLoad({ filter: /.*/, namespace: 'draco' }, () => ({ contents: dracoModule.code, loader: 'js' }));
      },
    },
    {
      // Shader text reaches the GPU without comments and indentation.
      name: 'shader-text',
      setup({ onLoad }) {
        onLoad({ filter: /(deform_shader|face_shader|environment)\.ts$/ }, ({ path }) => ({
          contents: shorterShaders(readFileSync(path, 'utf8')),
          loader: 'ts',
        }));
      },
    },
  ],
});

// Alone: bundlers copy it as a file, and it would not find there what it imports.
await build({ entryPoints: ['listen/worklet.ts'], absWorkingDir: here, outfile: join(dist, 'listen_worklet.js'), bundle: true, format: 'esm', target: 'es2022', minify: true, legalComments: 'none' });

// The one import by a variable is of Node's own module, which no bundler shall look for: the words that tell them do not
// survive the minifier.
let hidden = 0;
for (const name of readdirSync(dist)) {
  const text = readFileSync(join(dist, name), 'utf8');
  const told = text.replace(/\bimport\((\w+)\)/g, 'import(/* webpackIgnore: true */ /* @vite-ignore */ $1)');
  if (told === text) continue;
  hidden += 1;
  writeFileSync(join(dist, name), told);
}
if (hidden !== 1) throw new Error(`${hidden} files import by a variable`);

function shorterShaders(source) {
  return source.replace(/\/\* glsl \*\/ `[^`]*(?:\\`[^`]*)*`/g, (text) =>
    text
      .replace(/\\`/g, "'")
      .replace(/(?<=`[\s\S]*)\/\*\*?[\s\S]*?\*\//g, '')
      .replace(/\/\/[^\n]*/g, '')
      .replace(/\n\s+/g, '\n'),
  );
}

for (const file of wasm) cpSync(file, join(dist, basename(file)));
cpSync(join(dracoFolder, 'draco_decoder.wasm'), join(dist, 'draco_decoder.wasm'));
for (const name of ['package.json', 'README.md', 'example.html', 'greeting.html', 'greeting.css', 'greeting.js']) cpSync(join(here, name), join(folder, name));
cpSync(join(root, 'LICENSE'), join(folder, 'LICENSE'));
writeFileSync(
  join(folder, 'NOTICE'),
  'Semblante\nLicensed under the Apache License, Version 2.0: see LICENSE.\n\n' +
    'dist/draco_decoder.wasm and a part of dist/draco.js are Draco, https://github.com/google/draco,\n' +
    'Copyright The Draco Authors, Apache License, Version 2.0.\n',
);

const types = join(folder, 'types');
execFileSync(process.execPath, [tools.resolve('typescript/lib/tsc.js'), '-p', join(here, 'tsconfig.json'), '--outDir', types], {
  stdio: 'inherit',
});
for (const name of readdirSync(types, { recursive: true, withFileTypes: true })) {
  if (!name.isFile()) continue;
  const path = join(name.parentPath ?? name.path, name.name);
  // Declarations name the modules as they are published.
  writeFileSync(path, readFileSync(path, 'utf8').replace(/(from '|import\(")(\.[^'"]*)\.ts(?=['"])/g, '$1$2.js'));
}

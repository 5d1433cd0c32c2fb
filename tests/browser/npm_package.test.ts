import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, readdirSync, readFileSync, statSync, symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { build as bundle } from 'esbuild';
import { build, createServer } from 'vite';
import { expect, test } from 'vitest';
import { moves, project, run, server, unpacked, usePackedPackage } from './support/packed_package.ts';
import { root } from './support/paths.ts';

usePackedPackage();

const files = (folder: string): string[] =>
  (readdirSync(folder, { recursive: true }) as string[]).filter((name) => statSync(join(folder, name)).isFile());

/** As gzip makes it: Node's own zlib is Chromium's, whose files are 1 % larger. */
const gzipBytes = (file: string): number => execFileSync('gzip', ['-9nc', file]).length;

/** A module with all that it imports from its own package, gzipped. */
function gzipped(entry: string, seen = new Set<string>()): number {
  if (seen.has(entry)) return 0;
  seen.add(entry);
  const text = readFileSync(join(unpacked, 'dist', entry), 'utf8');
  const imports = [...text.matchAll(/(?:from|import)"\.\/([^"]+\.js)"/g)].map(([, name]) => name!);
  return gzipBytes(join(unpacked, 'dist', entry)) + imports.reduce((sum, name) => sum + gzipped(name, seen), 0);
}

test('Package_HasModulesAndDeclarations_AndNoSources', () => {
  const names = files(unpacked);
  for (const name of ['dist/index.js', 'dist/element.js', 'dist/three.js', 'dist/draco.js', 'dist/motion.js', 'dist/sound.js', 'dist/speech.js', 'dist/semblante_view.wasm', 'dist/semblante_motion.wasm', 'README.md', 'LICENSE'])
    expect(names).toContain(name);
  expect(names.filter((name) => name.endsWith('.ts') && !name.endsWith('.d.ts'))).toEqual([]);
  for (const name of names.filter((one) => /\.(js|d\.ts)$/.test(one))) {
    const text = readFileSync(join(unpacked, name), 'utf8');
    expect(text, name).not.toMatch(/from ?["'](@client|@protocol|draco-decoder)/);
    expect(text, name).not.toMatch(/from ?["'][^"']*[^d]\.ts["']/);
  }
  const { exports } = JSON.parse(readFileSync(join(unpacked, 'package.json'), 'utf8')) as { exports: Record<string, string | Record<string, string>> };
  for (const target of Object.values(exports).flatMap((one) => (typeof one === 'string' ? one : Object.values(one))))
    expect(names).toContain(target.replace('./', ''));
});

/** webpack and others answer for some of Node's names and not for their values. */
test('Package_HasNoNamesOfNode_ThatABundlerWouldAnswerFor', () => {
  for (const name of files(unpacked).filter((one) => one.endsWith('.js'))) {
    expect(readFileSync(join(unpacked, name), 'utf8'), name).not.toMatch(/__filename|__dirname|\bprocess\.|\brequire\(/);
  }
});

test.each([
  ['node16', 'node16'],
  ['esnext', 'bundler'],
  ['esnext', 'node10'],
])('Package_TypeScript_%s_%s_FindsTheDeclarationsOfEveryEntry', async (module, moduleResolution) => {
  const source = join(project, `types-${moduleResolution}`);
  mkdirSync(join(source, 'node_modules/@types'), { recursive: true });
  symlinkSync(unpacked, join(source, 'node_modules/semblante'));
  symlinkSync(join(root, 'web/node_modules/@types/three'), join(source, 'node_modules/@types/three'));
  const { exports } = JSON.parse(readFileSync(join(unpacked, 'package.json'), 'utf8')) as { exports: Record<string, { types?: string }> };
  const entries = Object.keys(exports).filter((name) => exports[name]!.types !== undefined);
  writeFileSync(
    join(source, 'use.ts'),
    `${entries.map((name, i) => `import * as m${i} from '${name.replace('.', 'semblante')}';`).join('\n')}
export const all = [${entries.map((_, i) => `m${i}`).join(', ')}];
const face = document.createElement('semblante-face');
face.addEventListener('statechange', (event) => console.log(event.detail.state.toUpperCase()));
face.addEventListener('error', ({ detail: { code, message } }) => console.log(code, message));
face.addEventListener('keydown', (event) => console.log(event.key));
face.addEventListener('mine', (event) => console.log(event.type));
`,
  );
  writeFileSync(join(source, 'package.json'), '{"type":"module"}');
  const compilerOptions = { module, moduleResolution, target: 'es2022', lib: ['es2022', 'dom'], strict: true, skipLibCheck: true, noEmit: true, types: [] };
  writeFileSync(join(source, 'tsconfig.json'), JSON.stringify({ compilerOptions, files: ['use.ts'] }));
  const faults = await run(process.execPath, [join(root, 'web/node_modules/typescript/lib/tsc.js'), '-p', source]).then(
    () => '',
    (error: { stdout: string }) => error.stdout,
  );
  expect(faults).toBe('');
});

/** Compiles one file as a stranger's project would, with declarations checked too. Returns what the compiler says. */
async function compile(name: string, file: string, text: string, options: object, packages: Record<string, string>): Promise<string> {
  const source = join(project, name);
  for (const [module, folder] of Object.entries({ ...packages, semblante: unpacked })) {
    mkdirSync(join(source, 'node_modules', module, '..'), { recursive: true });
    symlinkSync(folder, join(source, 'node_modules', module));
  }
  writeFileSync(join(source, file), text);
  writeFileSync(join(source, 'package.json'), '{"type":"module"}');
  const compilerOptions = { module: 'nodenext', target: 'es2022', strict: true, exactOptionalPropertyTypes: true, noEmit: true, types: [], ...options };
  writeFileSync(join(source, 'tsconfig.json'), JSON.stringify({ compilerOptions, files: [file] }));
  return run(process.execPath, [join(root, 'web/node_modules/typescript/lib/tsc.js'), '-p', source]).then(
    () => '',
    (error: { stdout: string }) => error.stdout,
  );
}

/** Node's own types have neither `WebAssembly` nor `BufferSource`. */
test('Package_TypeScriptForNodeAlone_NeedsNoTypesOfPages', async () => {
  const types = join(root, 'web/node_modules/@types/node');
  const undici = join(root, 'web/node_modules/undici-types');
  const text = `import { Kernel, loadFace, loadRuntime, neutralFrame, StreamClient } from 'semblante';
import { loadDraco } from 'semblante/draco';
import { Bridges, loadLibrary } from 'semblante/motion';
/** As packages for Node declare it: more ways to make it, other events. */
declare class Socket {
  constructor(address: string | URL, protocols?: string | string[], options?: { origin?: string });
  constructor(address: null);
  binaryType: 'nodebuffer' | 'arraybuffer' | 'fragments';
  readonly bufferedAmount: number;
  onopen: ((event: { target: Socket }) => void) | null;
  onclose: ((event: { code: number }) => void) | null;
  onerror: ((event: { message: string }) => void) | null;
  onmessage: ((event: { data: string | Uint8Array | ArrayBuffer | Uint8Array[] }) => void) | null;
  send(data: string | Uint8Array | ArrayBuffer, done?: (error?: Error) => void): void;
  close(code?: number, reason?: string | Uint8Array): void;
}
export const client = new StreamClient('ws://127.0.0.1:8080', { WebSocket: Socket });
export const all = [Kernel, loadFace, loadRuntime, neutralFrame, StreamClient, loadDraco, Bridges, loadLibrary];
`;
  expect(await compile('types-node', 'use.ts', text, { lib: ['es2022'], types: ['node'] }, { '@types/node': types, 'undici-types': undici })).toBe('');
});

/** What a handler of one's own, or a wrapper of a framework, declares as its parameters. */
test('Package_TypeScript_NamesWhatStreamsAndElementsTell', async () => {
  const text = `import { StreamClient, type End, type Face, type FaceFrame, type Frames, type Header, type InfluenceTable, type Keyframe, type QuantizerSteps, type StreamError } from 'semblante';
import type { EndReason, ExpressionBlend, SoundTrack, StreamErrorCode, StreamRole, VisemeBlend, VoiceState } from 'semblante';
import type { FaceAttributes, Fit, QualityName, SemblanteFace } from 'semblante/element';
const client = new StreamClient('ws://127.0.0.1:8080', { role: 'subscribe' satisfies StreamRole });
client.on('header', (header: Header) => console.log(header.sound satisfies SoundTrack | null));
client.on('keyframe', (keyframe: Keyframe) => keyframe.state satisfies FaceFrame);
client.on('frames', (frames: Frames) => frames.frames.map(({ state }) => [state.viseme satisfies VisemeBlend, state.expression satisfies ExpressionBlend]));
client.on('end', (end: End) => end.reason satisfies EndReason);
client.on('error', (error: StreamError) => error.code satisfies StreamErrorCode);
export const steps: QuantizerSteps = client.steps;
export const said = (state: VoiceState): void => client.spoken(state);
export const influence = (face: Face): InfluenceTable => face.influence;
export const attributes = (fit: Fit, quality: QualityName): FaceAttributes => ({ fit, quality });
export const fitOf = (face: SemblanteFace): Fit => face.fit;
`;
  expect(await compile('types-names', 'use.ts', text, { lib: ['es2022', 'dom'] }, {})).toBe('');
});

/** One program of all blocks in their order: a later one sees the names of those before it, and may have its own. */
test('Package_ReadmeInTypeScript_Compiles', async () => {
  const readme = readFileSync(join(unpacked, 'README.md'), 'utf8');
  const blocks = [...readme.matchAll(/^```ts\n(.*?)^```/gms)].map(([, block]) => block!).filter((block) => !block.includes("from 'react'"));
  expect(blocks.length).toBeGreaterThan(6);
  const lines = blocks.map((block) => block.split('\n'));
  const imports = new Set(lines.flat().filter((line) => line.startsWith('import ')));
  const bodies = lines.map((block) => block.filter((line) => !line.startsWith('import ')).join('\n'));
  const given = `import type { Scene } from 'three';
declare function showPositions(positions: Float32Array, triangles: Uint32Array): void;
declare const button: HTMLButtonElement, line: HTMLElement, picture: HTMLElement, scene: Scene;
`;
  const merged = new Map<string, Set<string>>();
  for (const line of imports) {
    const [, list, from] = /^import \{ (.*) \} from '(.*)';$/.exec(line)!;
    const known = merged.get(from!) ?? new Set();
    for (const name of list!.split(', ')) known.add(name);
    merged.set(from!, known);
  }
  const text = `${[...merged].map(([from, list]) => `import { ${[...list].join(', ')} } from '${from}';`).join('\n')}
${given}${bodies.join('\n{\n')}${'\n}'.repeat(bodies.length - 1)}\n`;
  const packages = { '@types/three': join(root, 'web/node_modules/@types/three') };
  expect(await compile('types-readme', 'readme.ts', text, { lib: ['es2022', 'dom'], skipLibCheck: true }, packages)).toBe('');
});

/** React's own types are not here: the block of the README with as much of them as it uses. */
test('Package_ReadmeForReact_GivesTheElementItsAttributes', async () => {
  const block = /^```ts\n(import type \{ DetailedHTMLProps.*?)^```/ms.exec(readFileSync(join(unpacked, 'README.md'), 'utf8'))![1]!;
  const react = join(project, 'react');
  mkdirSync(react, { recursive: true });
  writeFileSync(join(react, 'package.json'), '{"name":"react","types":"index.d.ts","exports":{".":{"types":"./index.d.ts"},"./jsx-runtime":{"types":"./jsx-runtime.d.ts"}}}');
  writeFileSync(
    join(react, 'index.d.ts'),
    `export interface HTMLAttributes<T> { className?: string | undefined; onClick?: ((target: T) => void) | undefined }
export type DetailedHTMLProps<E extends HTMLAttributes<T>, T> = { ref?: { current: T | null } | undefined } & E;
export namespace JSX { interface IntrinsicElements {} interface Element {} }
`,
  );
  writeFileSync(join(react, 'jsx-runtime.d.ts'), "export { JSX } from './index.js';\nexport declare function jsx(...all: unknown[]): unknown;\n");
  const use = (attributes: string): string => `${block}import 'semblante/element';\nexport const face = <semblante-face ${attributes} />;\n`;
  const options = { lib: ['es2022', 'dom'], jsx: 'react-jsx', skipLibCheck: true };
  const right = 'className="a" src="/" stream="demo" alt="Ana" fit="face" sound={false} voice="" captions orbit="none" model={undefined}';
  expect(await compile('types-react', 'use.tsx', use(right), options, { react })).toBe('');
  expect(await compile('types-react-wrong', 'use.tsx', use('fit="nose"'), options, { react })).toContain('"nose"');
});

test('Package_ClientWithLibrary_IsAtMost60kBGzipped', () => {
  const library = gzipBytes(join(unpacked, 'dist/semblante_view.wasm'));
  expect(gzipped('index.js') + library).toBeLessThanOrEqual(60_000);
});

test('Package_InNode_LoadsAFaceAndDeformsIt', async () => {
  writeFileSync(
    join(project, 'use.js'),
    `import { Kernel, loadFace, loadRuntime, neutralFrame } from 'semblante';
import { loadDraco } from 'semblante/draco';
const runtime = await loadRuntime();
const face = await loadFace(process.argv[2], 'sample', { draco: await loadDraco(), runtime });
const kernel = new Kernel(runtime, face);
const frame = neutralFrame();
frame.viseme = { select1: 10, select2: 0, blend: 63 };
kernel.evaluate(frame, 0);
const before = kernel.positions.slice();
kernel.deform(0);
console.log(before.filter((x, i) => x !== kernel.positions[i]).length);
`,
  );
  const { stdout: moved } = await run(process.execPath, ['use.js', server.url], { cwd: project });
  expect(Number(moved)).toBeGreaterThan(1000);
});

test('Package_InNode_ReadsTakesAndPlaysPerformances', async () => {
  writeFileSync(
    join(project, 'motion.js'),
    `import { Bridges, loadLibrary, Performance, readTake, writeTake } from 'semblante/motion';
import { readFileSync } from 'node:fs';
const library = await loadLibrary();
const performance = new Performance(library, readFileSync(process.argv[2]));
const frames = Array.from({ length: 10 }, (_, i) => ({ time: 40 * i, state: performance.frameAt(400 + 40 * i) }));
const take = readTake(library, 'fap', writeTake(library, 'fap', frames));
const jaw = new Bridges(library).fromArkit({ jawOpen: 0.5 }).frame.levels[3];
console.log(JSON.stringify([take.frames.length, take.frames[5].state.viseme, jaw > 50]));
`,
  );
  const document = join(root, 'protocol/examples/performances/hello.json');
  const { stdout } = await run(process.execPath, ['motion.js', document], { cwd: project });
  const [count, viseme, isOpen] = JSON.parse(stdout) as [number, { select1: number }, boolean];
  expect([count, isOpen]).toEqual([10, true]);
  expect(viseme.select1).toBeGreaterThan(0);
});

test('Package_BuiltByVite_ShowsAMovingFace', async () => {
  const source = join(project, 'site');
  mkdirSync(source);
  writeFileSync(join(source, 'index.html'), '<!doctype html><script type="module" src="./main.js"></script><semblante-face stream="demo"></semblante-face>');
  writeFileSync(join(source, 'main.js'), "import 'semblante/element';");
  await build({ root: source, base: './', logLevel: 'error', configFile: false, build: { outDir: join(project, 'built'), assetsInlineLimit: 0 } });
  await moves('/built/');
});

/** As the README says: the files are copied, under their names. */
test('Package_BundledByEsbuild_ShowsAMovingFace_AndHearsSound', async () => {
  const source = join(project, 'bundle');
  const out = join(project, 'bundled');
  mkdirSync(source);
  writeFileSync(
    join(source, 'main.js'),
    `import 'semblante/element';
import { listenFiles, listenTo } from 'semblante/listen';
window.hear = async () => {
  const context = new OfflineAudioContext(1, 48000, 48000);
  let count = 0;
  const tone = context.createOscillator();
  await listenTo(tone, listenFiles, () => (count += 1));
  tone.start();
  await context.startRendering();
  while (count === 0) await new Promise((done) => setTimeout(done, 10));
  return count;
};`,
  );
  await bundle({ entryPoints: [join(source, 'main.js')], bundle: true, format: 'esm', outdir: out, logLevel: 'error' });
  writeFileSync(join(out, 'index.html'), '<!doctype html><script type="module" src="./main.js"></script><semblante-face stream="demo"></semblante-face>');
  const dist = join(unpacked, 'dist');
  for (const name of readdirSync(dist).filter((one) => one.endsWith('.wasm') || one === 'listen_worklet.js')) cpSync(join(dist, name), join(out, name));
  await moves('/bundled/', server.url, async (page) => {
    expect(await page.evaluate(() => (window as unknown as { hear(): Promise<number> }).hear())).toBeGreaterThan(0);
  });
});

/** The setting of the README: without it this Vite moves the modules away from their WebAssembly. */
test('Package_InVitesDevelopmentServer_ShowsAMovingFace', async () => {
  const source = join(project, 'development');
  mkdirSync(source);
  writeFileSync(join(source, 'index.html'), '<!doctype html><script type="module" src="./main.js"></script><semblante-face stream="demo"></semblante-face>');
  writeFileSync(join(source, 'main.js'), "import 'semblante/element';");
  const proxied = { target: server.url, ws: true, changeOrigin: true, rewriteWsOrigin: true };
  const development = await createServer({
    root: source,
    configFile: false,
    logLevel: 'error',
    optimizeDeps: { exclude: ['semblante'] },
    server: { host: '127.0.0.1', port: 0, hmr: false, fs: { allow: [project] }, proxy: { '/v1': proxied } },
  });
  try {
    await development.listen();
    const address = development.httpServer!.address() as { port: number };
    await moves('/', `http://127.0.0.1:${address.port}`);
  } finally {
    await development.close();
  }
});

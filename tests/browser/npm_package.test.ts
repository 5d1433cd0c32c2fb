import { execFile, execFileSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, symlinkSync, writeFileSync } from 'node:fs';
import { createServer as createHttpServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { promisify } from 'node:util';
import type { Page } from 'playwright-core';
import { build as bundle } from 'esbuild';
import { build, createServer } from 'vite';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { buildDir, root } from './support/paths.ts';
import { patience } from './support/patience.ts';
import { startServer, type RunningServer } from './support/server.ts';
import { browser, useBrowser } from './support/suite.ts';
import { everyVariant } from './support/variants.ts';

/** Does not block: the runner asks for signs of life. */
const run = promisify(execFile);

/** A project of a stranger, with the packed package in node_modules. */
let project: string;
let unpacked: string;
let server: RunningServer;

useBrowser();
beforeAll(async () => {
  project = mkdtempSync(join(tmpdir(), 'semblante-npm-'));
  const folder = join(project, 'made');
  const environment = { ...process.env, SEMBLANTE_BUILD: buildDir };
  await run(process.execPath, [join(root, 'clients/js/build.mjs'), folder], { env: environment });
  const pack = ['pack', '--silent', '--ignore-scripts', '--pack-destination', project];
  const { stdout: packed } = await run('npm', pack, { cwd: folder });
  unpacked = join(project, 'node_modules/semblante');
  mkdirSync(unpacked, { recursive: true });
  await run('tar', ['-xzf', join(project, packed.trim().split('\n').at(-1)!), '--strip-components=1', '-C', unpacked]);
  writeFileSync(join(project, 'package.json'), '{"type":"module","private":true}');
  server = await startServer({ pages: project, voice: join(buildDir, 'bin/semblante-voice-espeak') });
});
afterAll(async () => {
  await server?.stop();
  rmSync(project, { recursive: true, force: true });
});

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

/** Opens a page of the project, which the real server serves, waits until its face moves, and does more with it. */
async function moves(path: string, origin = server.url, more?: (page: Page) => Promise<void>): Promise<void> {
  const page = await browser.newPage();
  try {
    page.setDefaultTimeout(patience);
    const errors: string[] = [];
    page.on('pageerror', (error) => errors.push(String(error)));
    page.on('console', (message) => {
      if (message.type() === 'error' && !message.location().url.endsWith('/favicon.ico')) errors.push(message.text());
    });
    await page.goto(origin + path, { timeout: patience });
    await page.waitForFunction(() => (document.querySelector('semblante-face') as { state?: string } | null)?.state === 'playing');
    await more?.(page).catch((error: unknown) => {
      expect(errors).toEqual([]); // tells more
      throw error;
    });
    expect(errors).toEqual([]);
  } finally {
    await page.close();
  }
}

test('Package_BarePage_ShowsAMovingFace', async () => {
  const example = join(unpacked, 'example.html');
  const page = readFileSync(example, 'utf8');
  expect(page.split('\n').length).toBeLessThanOrEqual(10);
  expect(page).toContain('http://127.0.0.1:8080');
  writeFileSync(example, page.replace('http://127.0.0.1:8080', server.url));
  await moves('/node_modules/semblante/example.html');
});

test('Package_ElementOfAFramework_TakesWhatWasSetBeforeItIsDefined_AndWhatIsTakenAway', async () => {
  const early = "{ src: '', stream: 'demo', alt: 'Ana', model: 'sample', token: null, captions: true }";
  writeFileSync(join(project, 'early.js'), `Object.assign(document.querySelector('semblante-face'), ${early});`);
  writeFileSync(
    join(project, 'early.html'),
    `<!doctype html><semblante-face></semblante-face><script src="early.js"></script>
<script type="module" src="node_modules/semblante/dist/element.js"></script>`,
  );
  await moves('/early.html', server.url, async (page) => {
    const attributes = (): Promise<Record<string, string>> =>
      page.evaluate(() => {
        const face = document.querySelector('semblante-face')!;
        return Object.fromEntries(face.getAttributeNames().map((name) => [name, face.getAttribute(name)!]));
      });
    expect(await attributes()).toEqual({ src: '', stream: 'demo', alt: 'Ana', model: 'sample', captions: '' });
    expect(await page.getByRole('img', { name: 'Ana' }).count()).toBe(1);
    await page.evaluate(() => {
      const gone = { alt: null, model: undefined, poster: null, fit: undefined, quality: null, theme: undefined, captions: undefined };
      Object.assign(document.querySelector('semblante-face')!, gone);
    });
    expect(await attributes()).toEqual({ src: '', stream: 'demo' });
    await page.waitForFunction(() => (document.querySelector('semblante-face') as { state?: string } | null)?.state === 'playing');
  });
});

/** React 18 writes `sound="false"` for `sound={false}`. */
test('Package_ElementWithTheWordFalse_IsOffAndAsWithoutTheAttribute', async () => {
  writeFileSync(
    join(project, 'false.html'),
    `<!doctype html><semblante-face stream="demo" sound="false" voice="false" captions="false"></semblante-face>
<script type="module" src="node_modules/semblante/dist/element.js"></script>`,
  );
  type Switches = HTMLElement & { sound: boolean; voice: boolean; captions: boolean };
  await moves('/false.html', server.url, async (page) => {
    const switches = (): Promise<boolean[]> =>
      page.evaluate(() => {
        const { sound, voice, captions } = document.querySelector('semblante-face') as Switches;
        return [sound, voice, captions];
      });
    const button = page.getByRole('button', { name: /^(Sound|Voice)/ });
    expect(await switches()).toEqual([false, false, false]);
    expect(await button.count()).toBe(0);
    await page.evaluate(() => document.querySelector('semblante-face')!.setAttribute('sound', 'true'));
    expect(await switches()).toEqual([true, false, false]);
    await button.waitFor(); // the server has a voice
  });
});

test('Package_ElementWhoseSoundVoiceOrTokenChanges_KeepsItsFace', async () => {
  writeFileSync(
    join(project, 'switch.html'),
    `<!doctype html><semblante-face stream="demo"></semblante-face>
<script type="module" src="node_modules/semblante/dist/element.js"></script>`,
  );
  type Switched = HTMLElement & { sound: boolean; voice: boolean; token: string; state: string; canvas: Element | null; states: string[] };
  await moves('/switch.html', server.url, async (page) => {
    const parts: string[] = [];
    const tokens: (string | undefined)[] = [];
    const hellos: Buffer[] = [];
    page.on('request', (request) => {
      if (/\/(mesh\.drc|weights|rig\.json)/.test(request.url())) parts.push(request.url());
      if (request.url().endsWith('/v1/streams/demo')) tokens.push(request.headers()['authorization']);
    });
    page.on('websocket', (socket) => {
      let isFirst = true;
      socket.on('framesent', ({ payload }) => {
        if (isFirst) hellos.push(Buffer.from(payload));
        isFirst = false;
      });
    });
    await page.evaluate(() => {
      const face = document.querySelector<Switched>('semblante-face')!;
      face.canvas = face.shadowRoot!.querySelector('canvas');
      face.states = [];
      face.addEventListener('statechange', (event) => face.states.push((event as CustomEvent<{ state: string }>).detail.state));
    });
    const put = (change: { sound?: boolean; voice?: boolean; token?: string }): Promise<void> =>
      page.evaluate((change) => void Object.assign(document.querySelector<Switched>('semblante-face')!, change), change);
    const connected = async (count: number): Promise<void> => expect.poll(() => hellos.length, { timeout: patience }).toBe(count);

    await put({ voice: true });
    await put({ voice: false });
    await put({ sound: true });
    await connected(1); // the voice needs no connection
    await page.getByRole('button', { name: 'Sound on' }).click();
    await page.getByRole('button', { name: 'Sound off' }).waitFor();
    await put({ token: 'abc' });
    await connected(2);
    await page.getByRole('button', { name: 'Sound off' }).waitFor(); // still heard
    await put({ token: 'abc' }); // no change
    await put({ sound: false });
    await connected(3);
    await expect.poll(() => page.getByRole('button', { name: /^Sound/ }).count(), { timeout: patience }).toBe(0);
    expect(tokens).toEqual(['Bearer abc']);
    expect(hellos[0]).toEqual(hellos[1]);
    expect(hellos[2]).not.toEqual(hellos[1]);
    expect(parts).toEqual([]);
    await page.evaluate(async () => {
      const face = document.querySelector<Switched>('semblante-face')!;
      if (face.shadowRoot!.querySelector('canvas') !== face.canvas) throw new Error('another picture');
      if (face.states.some((state) => state !== 'playing')) throw new Error(face.states.join());
      const poses = (): string => Array.from((face as unknown as { show: { kernel: { poses: { featurePoints: Float32Array }[] } } }).show.kernel.poses[0]!.featurePoints).join();
      for (const before = poses(); poses() === before; ) await new Promise(requestAnimationFrame); // it moves
    });
  });
});

/** As a framework does with a list that is sorted. */
test('Package_ElementMovedWithinItsPage_GoesOn_AndOneTakenOffEnds', async () => {
  writeFileSync(
    join(project, 'sort.html'),
    `<!doctype html><main></main><semblante-face stream="demo"></semblante-face>
<script type="module" src="node_modules/semblante/dist/element.js"></script>`,
  );
  await moves('/sort.html', server.url, async (page) => {
    const next = page.waitForEvent('websocket', { timeout: patience });
    await page.evaluate(async () => {
      const face = document.querySelector('semblante-face')!;
      const canvas = face.shadowRoot!.querySelector('canvas');
      document.querySelector('main')!.append(face);
      await new Promise((done) => requestAnimationFrame(done));
      if ((face as unknown as { state: string }).state !== 'playing' || face.shadowRoot!.querySelector('canvas') !== canvas) throw new Error('began again');
      face.remove();
      await new Promise((done) => requestAnimationFrame(done));
      if ((face as unknown as { state: string }).state !== 'idle') throw new Error('goes on');
      document.body.append(face);
    });
    await next; // the first since the page moved
    await page.waitForFunction(() => (document.querySelector('semblante-face') as { state?: string } | null)?.state === 'playing');
  });
});

/** As with a picture in picture: the pictures of a page that is hidden do not go on, those of the other window do. */
test('Package_ElementMovedToAnotherWindow_IsDrawnThereAsBefore', async () => {
  writeFileSync(
    join(project, 'move.html'),
    `<!doctype html><iframe width="400" height="500"></iframe><semblante-face stream="demo" captions></semblante-face>
<script type="module" src="node_modules/semblante/dist/element.js"></script>`,
  );
  await moves('/move.html', server.url, async (page) => {
    await page.evaluate(() => {
      const face = document.querySelector('semblante-face')!;
      document.implementation.createHTMLDocument().body.append(face); // no window shows it
      window.requestAnimationFrame = () => 0;
      document.querySelector('iframe')!.contentDocument!.body.append(face);
    });
    const face = page.frameLocator('iframe').locator('semblante-face');
    await expect.poll(() => face.evaluate((one) => (one as unknown as { state: string }).state), { timeout: patience }).toBe('playing');
    const shown = await face.evaluate((one) => {
      const { width, height } = one.getBoundingClientRect();
      return { width, height, sheets: one.shadowRoot!.adoptedStyleSheets.length };
    });
    expect(shown).toEqual({ width: 320, height: 400, sheets: 2 });
  });
});

/** Of a region of the page, from two pictures of it: the share of pixels that the face covers, and of those that changed. */
interface Seen {
  covered: number;
  changed: number;
}

/** What two pictures of a page show at these places: what the first covers, and what the second changes. */
async function compare(page: Page, places: { x: number; y: number; width: number; height: number }[], pictures: Buffer[]): Promise<Seen[]> {
  const addresses = pictures.map((picture) => `data:image/png;base64,${picture.toString('base64')}`);
  return page.evaluate(
    async ([regions, sources]) => {
      const [first, second] = await Promise.all(
        sources.map(async (source) => {
          const image = new Image();
          image.src = source;
          await image.decode();
          const canvas = new OffscreenCanvas(image.width, image.height);
          const context = canvas.getContext('2d')!;
          context.drawImage(image, 0, 0);
          return context;
        }),
      );
      return regions.map(({ x, y, width, height }) => {
        const [before, after] = [first!, second!].map((context) => context.getImageData(x, y, width, height).data);
        let covered = 0;
        let changed = 0;
        for (let i = 0; i < before!.length; i += 4) {
          const differs = (a: ArrayLike<number>, from: number, b: ArrayLike<number>): boolean =>
            [0, 1, 2].some((channel) => Math.abs(a[from + channel]! - b[i + channel]!) > 12);
          if (differs(before!, 0, before!)) covered += 1; // the first pixel is a corner: background
          if (differs(before!, i, after!)) changed += 1;
        }
        return { covered: covered / (width * height), changed: changed / (width * height) };
      });
    },
    [places, addresses] as const,
  );
}

type Faces = NodeListOf<HTMLElement & { state: string }>;

/** A browser gives a page 16 contexts of WebGL. Without a graphics card each face costs as much as the whole studio. */
test.runIf(everyVariant)('Package_ManyFaces_AreAllDrawnAndMove_AlsoAfterTheirContextsAreLost_AndWhenTheyAreSeenAgain', async () => {
  const count = 24;
  // All contexts of the page with the number of their textures, and the faces that say that they are not drawn.
  writeFileSync(
    join(project, 'contexts.js'),
    `const { getContext } = HTMLCanvasElement.prototype;
window.contexts = new Set();
window.lost = new Set();
window.textures = 0;
const { createTexture, deleteTexture } = WebGL2RenderingContext.prototype;
WebGL2RenderingContext.prototype.createTexture = function () {
  textures += 1;
  return createTexture.call(this);
};
WebGL2RenderingContext.prototype.deleteTexture = function (texture) {
  if (texture) textures -= 1;
  deleteTexture.call(this, texture);
};
HTMLCanvasElement.prototype.getContext = function (kind, ...options) {
  const context = getContext.call(this, kind, ...options);
  if (kind === 'webgl2') contexts.add(context);
  return context;
};
document.addEventListener('statechange', ({ target, detail }) => detail.state === 'loading' && lost.add(target), true);`,
  );
  writeFileSync(join(project, 'many.css'), 'body { margin: 0; display: flex; flex-wrap: wrap } semblante-face { width: 100px; height: 120px }');
  writeFileSync(
    join(project, 'many.html'),
    `<!doctype html><link rel="stylesheet" href="many.css"><script src="contexts.js"></script><body>${'<semblante-face stream="demo"></semblante-face>'.repeat(count)}
<script type="module" src="node_modules/semblante/dist/element.js"></script>`,
  );
  await moves('/many.html', server.url, async (page) => {
    const places = await page.evaluate(() =>
      [...document.querySelectorAll('semblante-face')].map((face) => {
        const { x, y, width, height } = face.getBoundingClientRect();
        return { x, y, width, height };
      }),
    );
    const picture = (): Promise<Buffer> => page.screenshot({ timeout: patience });
    /** A face that speaks changes at least at its mouth: until every one has, and none is blank. */
    const allMove = async (): Promise<void> => {
      await page.waitForFunction(() => [...(document.querySelectorAll('semblante-face') as Faces)].every(({ state }) => state === 'playing'));
      let last = await picture(); // a face may still fade in
      const moved = new Set<number>();
      await expect
        .poll(
          async () => {
            const next = await picture();
            const seen = await compare(page, places, [last, next]);
            last = next;
            seen.forEach(({ covered, changed }, i) => {
              if (covered > 0.25 && changed > 0.002) moved.add(i);
            });
            const states = await page.evaluate(() => [...(document.querySelectorAll('semblante-face') as Faces)].map(({ state }) => state));
            return seen.flatMap(({ covered, changed }, i) => (moved.has(i) ? [] : [`face ${i}, ${states[i]}: ${covered} covered, ${changed} changed`]));
          },
          { timeout: patience, interval: 500 },
        )
        .toEqual([]);
    };
    await allMove();
    const textures = (): Promise<number> => page.evaluate(() => (window as unknown as { textures: number }).textures);
    const scroll = (margin: string): Promise<void> => page.evaluate((top) => void (document.body.style.marginTop = top), margin);
    const before = await textures();
    await scroll('5000px');
    await expect.poll(textures, { timeout: patience }).toBeLessThan(before - count);
    await scroll('0');
    await allMove();
    // Some come back, as after a reset of the graphics card; others do not, as when the page has too many.
    await page.evaluate(() => {
      const { contexts, lost } = window as unknown as { contexts: Set<WebGL2RenderingContext>; lost: Set<EventTarget> };
      lost.clear();
      [...contexts]
        .map((context) => context.getExtension('WEBGL_lose_context'))
        .filter((extension) => extension !== null)
        .forEach((extension, i) => {
          extension.loseContext();
          if (i % 2 === 0) setTimeout(() => extension.restoreContext(), 100);
        });
    });
    await page.waitForFunction((faces) => (window as unknown as { lost: Set<EventTarget> }).lost.size === faces, count);
    await allMove();
    const pictures = join(buildDir, 'screenshots');
    mkdirSync(pictures, { recursive: true });
    writeFileSync(join(pictures, 'many_faces.png'), await picture());
  });
});

/** A stranger's server of the project: its pages have no Content-Security-Policy, as those of `server` have. */
async function stranger(): Promise<{ url: string; stop: () => Promise<void> }> {
  const types: Record<string, string> = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm' };
  const pages = createHttpServer(({ url }, answer) => {
    const file = join(project, new URL(url!, 'http://localhost').pathname);
    const type = types[extname(file)];
    if (type === undefined || !existsSync(file)) return void answer.writeHead(404).end();
    answer.writeHead(200, { 'Content-Type': type }).end(readFileSync(file));
  });
  await new Promise<void>((listening) => pages.listen(0, '127.0.0.1', listening));
  return { url: `http://127.0.0.1:${(pages.address() as AddressInfo).port}`, stop: () => new Promise((stopped) => void pages.close(() => stopped())) };
}

test('Package_PageOfAnotherOrigin_SaysInTheConsoleHowItIsAllowed', async () => {
  const face = `<semblante-face src="${server.url}" stream="demo"></semblante-face>`;
  writeFileSync(join(project, 'foreign.html'), `<!doctype html>${face}<script type="module" src="node_modules/semblante/dist/element.js"></script>`);
  const other = await stranger();
  const page = await browser.newPage();
  try {
    const isHint = (text: string): boolean => text.endsWith(`semblante serve --allow-origin ${other.url}`);
    const hint = page.waitForEvent('console', { predicate: (message) => isHint(message.text()), timeout: patience });
    await page.goto(`${other.url}/foreign.html`, { timeout: patience });
    expect((await hint).type()).toBe('warning');
  } finally {
    await page.close();
    await other.stop();
  }
});

test('Package_ServerThatThePagesPolicyForbids_IsToldFromOneThatDoesNotAnswer', async () => {
  writeFileSync(join(project, 'trouble.js'), "document.querySelector('semblante-face').addEventListener('error', ({ detail }) => (globalThis.code ??= detail.code));");
  const pageOf = (src: string, policy: string): string =>
    `<!doctype html>${policy && `<meta http-equiv="Content-Security-Policy" content="connect-src ${policy}">`}<semblante-face src="${src}" stream="demo"></semblante-face>
<script src="trouble.js"></script><script type="module" src="node_modules/semblante/dist/element.js"></script>`;
  const other = await stranger();
  const page = await browser.newPage();
  const codeOn = async (src: string, policy: string): Promise<unknown> => {
    writeFileSync(join(project, 'trouble.html'), pageOf(src, policy));
    await page.goto(`${other.url}/trouble.html`, { timeout: patience });
    return (await page.waitForFunction(() => (globalThis as { code?: string }).code, undefined, { timeout: patience })).jsonValue();
  };
  try {
    expect(await codeOn(server.url, "'self'")).toBe('policy');
    expect(await codeOn(server.url, '')).toBe('unreachable'); // it refuses this origin
    expect(await codeOn(other.url, server.url)).toBe('policy');
  } finally {
    await page.close();
    await other.stop();
  }
});

test('Package_Greeting_IsSaidInBothLanguages', async () => {
  const greeting = join(unpacked, 'greeting.html');
  writeFileSync(greeting, readFileSync(greeting, 'utf8').replace('http://127.0.0.1:8080', server.url));
  const playing = async (): Promise<string | undefined> => {
    const stream = (await (await fetch(`${server.url}/v1/streams/demo`)).json()) as { playing: { id: string } | null };
    return stream.playing?.id;
  };
  await moves('/node_modules/semblante/greeting.html', server.url, async (page) => {
    const said = new Set([await playing(), undefined]);
    for (const name of ['Hello!', 'Olá!']) {
      await page.getByRole('button', { name }).click();
      let now: string | undefined;
      await expect.poll(async () => said.has((now = await playing())), { timeout: patience }).toBe(false);
      said.add(now);
      expect(await page.getByRole('status').textContent()).toBe('');
    }
  });
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

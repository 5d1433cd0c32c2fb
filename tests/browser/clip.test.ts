import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { build } from 'esbuild';
import { createDecoderModule } from 'draco3d';
import { validateBytes } from 'gltf-validator';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { assembleFace, Kernel, neutralFrame, Runtime, type DracoModule, type Face, type FaceFrame } from '@client/index.ts';
import { standardQuantizers } from '@protocol/index.ts';
import { buildDir, root, sampleHead, samplePoints } from './support/paths.ts';
import { patience } from './support/patience.ts';
import { launch } from './support/studio_page.ts';
import type { ClipReport } from './pages/play_clip.ts';

/** Times in ms; values are multiples of the standard steps, so that quantization is exact. */
const frames = [
  { time: 0 },
  {
    time: 400,
    expression: { select1: 1, intensity1: 63 },
    faps: { 3: 300, 23: 11008, 24: 11008, 29: 100, 49: 20016, 50: 8064 },
  },
  { time: 800, viseme: { select1: 11, select2: 0, blend: 63 }, faps: { 19: 400, 20: 400, 48: 12000, 31: 200 } },
  { time: 1000 },
];

interface Player {
  openClip(url: string): Promise<ClipReport>;
  positionsAt(seconds: number): number[][];
  drawBeside(seconds: number, vertices: number[][]): void;
}
type Window = { player: Player };

let browser: Browser;
let page: Page;
let folder: string;
let face: Face;
let kernel: Kernel;
let clip: Uint8Array;
const errors: string[] = [];

const semblante = (...given: string[]): void =>
  void execFileSync(join(buildDir, 'bin/semblante'), given, { stdio: ['ignore', 'ignore', 'inherit'] });

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), 'semblante-clip-'));
  const parts = join(folder, 'package');
  semblante('parametrize', sampleHead, '--points', samplePoints, '--weights', 'smooth', '--out', parts, '--quiet');
  writeFileSync(join(folder, 'frames.json'), JSON.stringify({ frames }));
  semblante('convert', join(folder, 'frames.json'), '--package', parts, '--out', join(folder, 'clip.glb'));
  clip = readFileSync(join(folder, 'clip.glb'));
  const draco = (await createDecoderModule({})) as DracoModule;
  const runtime = await Runtime.load(() => readFileSync(join(buildDir, 'wasm/semblante_view.wasm')));
  face = await assembleFace(
    readFileSync(join(parts, 'rig.json')),
    readFileSync(join(parts, 'weights')),
    readFileSync(join(parts, 'mesh.drc')),
    draco,
    runtime,
  );
  kernel = new Kernel(runtime, face);

  browser = await launch();
  page = await browser.newPage({ viewport: { width: 800, height: 440 } });
  page.setDefaultTimeout(patience);
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  page.on('pageerror', (error) => errors.push(String(error)));
  const bundle = await build({
    entryPoints: [join(root, 'tests/browser/pages/play_clip.ts')],
    bundle: true,
    format: 'esm',
    footer: { js: 'globalThis.player = { openClip, positionsAt, drawBeside };' },
    write: false,
    nodePaths: [join(root, 'web/node_modules')],
    logLevel: 'silent',
  });
  // No server: this route serves the page and the file.
  await page.route('http://clip.test/**', (route) =>
    route.request().url().endsWith('clip.glb')
      ? route.fulfill({ body: Buffer.from(clip), contentType: 'model/gltf-binary' })
      : route.fulfill({ body: '<!doctype html><link rel="icon" href="data:,">', contentType: 'text/html' }),
  );
  await page.goto('http://clip.test/');
  await page.addScriptTag({ content: bundle.outputFiles[0]!.text, type: 'module' });
  await page.waitForFunction(() => 'player' in window);
});

afterAll(async () => {
  await browser?.close();
  if (folder) rmSync(folder, { recursive: true, force: true });
});

function evaluate(index: number, pose: number): void {
  const given = frames[index]!;
  const frame: FaceFrame = neutralFrame();
  Object.assign(frame.viseme, given.viseme);
  Object.assign(frame.expression, given.expression);
  for (const [fap, value] of Object.entries(given.faps ?? {}))
    frame.levels[Number(fap)] = Math.round(value / standardQuantizers[Number(fap)]!);
  kernel.evaluate(frame, pose);
}

/** The kernel's vertices at a time, in the order of the clip's primitives: by material, then by vertex number. */
function kernelAt(ms: number): number[][] {
  const next = frames.findIndex(({ time }) => time >= ms);
  const before = Math.max(0, next - 1);
  evaluate(before, 0);
  evaluate(next, 1);
  const span = frames[next]!.time - frames[before]!.time;
  kernel.interpolate(0, 1, span === 0 ? 0 : (ms - frames[before]!.time) / span, 2);
  kernel.deform(2);
  const out: number[][] = face.rig.materials.map(() => []);
  for (let v = 0; v < face.rig.mesh.vertices; v += 1)
    out[face.mesh.materials![v]!]!.push(...kernel.positions.subarray(v * 3, v * 3 + 3));
  return out.filter((vertices) => vertices.length > 0);
}

describe('animation clip, played by others', () => {
  test('Clip_KhronosValidator_FindsNothing', async () => {
    const report = await validateBytes(clip);
    expect(report.issues.messages.filter(({ severity }) => severity < 2)).toEqual([]); // errors and warnings
    expect(report.info).toMatchObject({ animationCount: 1, hasSkins: true, hasTextures: true, maxInfluences: 8 });
    expect(report.info.totalTriangleCount).toBe(face.rig.mesh.triangles);
    expect(report.info.totalVertexCount).toBe(face.rig.mesh.vertices);
  });

  test('Clip_ThreeJs_PlaysTheKernelsVertices', async () => {
    const report = await page.evaluate(() => (window as unknown as Window).player.openClip('/clip.glb'));
    expect(report.animations).toEqual(['frames']);
    expect(report.duration).toBeCloseTo(1, 5);
    expect(report.extras['influences']).toBe(8);
    expect(report.bones).toBe(report.extras['joints']);
    expect(report.channels).toBe(report.extras['channels']);
    const quantum = report.extras['quantum'] as number;
    // three.js uses four influences per vertex; omitted keys add half a quantum each for displacement, eye and head.
    const allowed = (report.extras['error_first_four'] as number) + 1.5 * quantum;
    const size = Math.max(...face.rig.bounds.max.map((value, axis) => value - face.rig.bounds.min[axis]!));
    expect(allowed).toBeLessThan(0.013 * size);
    for (const ms of [0, 200, 400, 500, 600, 800, 900]) {
      const shown = await page.evaluate((s) => (window as unknown as Window).player.positionsAt(s), ms / 1000);
      const expected = kernelAt(ms);
      expect(shown.map((vertices) => vertices.length)).toEqual(expected.map((vertices) => vertices.length));
      let worst = 0;
      let moved = 0;
      const rest = kernelAt(0);
      expected.forEach((vertices, p) => {
        for (let i = 0; i < vertices.length; i += 3) {
          const from = (other: number[][]): number =>
            Math.hypot(...[0, 1, 2].map((axis) => other[p]![i + axis]! - vertices[i + axis]!));
          worst = Math.max(worst, from(shown));
          moved = Math.max(moved, from(rest));
        }
      });
      // three.js interpolates rotations by slerp, the kernel by nlerp: they differ by 1e-4 of the size for these steps.
      expect(worst, `${ms} ms`).toBeLessThan(allowed + 1e-4 * size);
      if (ms > 0) expect(moved).toBeGreaterThan(0.02 * size);
    }
    expect(errors).toEqual([]);
  });

  test('Clip_Drawn_LooksLikeOurs', async () => {
    const pictures = join(buildDir, 'screenshots');
    mkdirSync(pictures, { recursive: true });
    for (const ms of [400, 800]) {
      await page.evaluate(([s, vertices]) => (window as unknown as Window).player.drawBeside(s, vertices), [
        ms / 1000,
        kernelAt(ms),
      ] as const);
      await page.screenshot({ path: join(pictures, `clip-${ms}.png`) });
      // Compares the two halves of the picture pixel by pixel, without the background.
      const difference = await page.evaluate(() => {
        const source = document.querySelector('canvas')!;
        const copy = document.createElement('canvas');
        copy.width = source.width;
        copy.height = source.height;
        const context = copy.getContext('2d')!;
        context.drawImage(source, 0, 0);
        const half = source.width / 2;
        const [left, right] = [0, half].map((x) => context.getImageData(x, 0, half, source.height).data);
        const tally = { drawn: 0, left: 0, right: 0 };
        const background = [...left!.subarray(0, 3)];
        const isFace = (data: Uint8ClampedArray, i: number): boolean =>
          background.some((value, c) => Math.abs(data[i + c]! - value) > 6);
        for (let i = 0; i < left!.length; i += 4) {
          if (isFace(left!, i)) tally.left += 1;
          if (isFace(right!, i)) tally.right += 1;
        }
        return tally;
      });
      expect(difference.left).toBeGreaterThan(10_000);
      // The halves are seen from slightly different sides, so the sizes differ a little.
      expect(Math.abs(difference.left - difference.right) / difference.left).toBeLessThan(0.15);
    }
    expect(errors).toEqual([]);
  });
});

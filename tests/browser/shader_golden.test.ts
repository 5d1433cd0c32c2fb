import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { expect, test } from 'vitest';
import { Kernel, neutralFrame, Runtime, type Face, type Pose } from '../../clients/js/index.ts';
import { featurePoints } from '../../protocol/ts/generated/mpeg4.ts';
import { rigFapus, type RigDocument, type Vec3 } from '../../protocol/ts/index.ts';
import { buildDir } from './support/paths.ts';
import { patience } from './support/patience.ts';
import type { GoldenMesh } from './support/golden_page.ts';
import { browser, useBrowser } from './support/suite.ts';

const here = (path: string): string => fileURLToPath(new URL(path, import.meta.url));

/** Dense numbers of point and leader, share. */
type Followers = [number, number, number][];

interface Golden {
  tolerance: { position: number };
  rig: {
    fapu: number[];
    eye_pivot: [Vec3, Vec3];
    head_pivot: Vec3;
    irises: RigDocument['irises'];
    tongue: RigDocument['tongue'];
    lids: RigDocument['lids'];
    companions: Followers;
    lower_lip: Followers;
    viseme_share: number;
    visemes: Record<string, Vec3>[];
    expressions: Record<string, Vec3>[];
  };
  face: { rest: Vec3[]; normals: Vec3[]; triangles: Vec3[]; rows: [number, number][][]; rigid: number[]; turn: number[] };
  cases: {
    name: string;
    frame: {
      viseme: { select1: number; select2: number; blend: number };
      expression: { select1: number; intensity1: number; select2: number; intensity2: number };
      faps: Record<string, number>;
    };
    jaw_takes_lip?: boolean;
    positions: number[];
  }[];
  interpolations: { from: number; to: number; t: number; positions: number[] }[];
}

const golden = JSON.parse(
  readFileSync(here('../../protocol/vectors/kernel/golden-frames.json'), 'utf8'),
) as Golden;

function rigOf({ rig }: Golden): RigDocument {
  const named = (set: Record<string, Vec3>) => ({
    name: '',
    displacements: Object.fromEntries(Object.entries(set).map(([fp, by]) => [featurePoints[Number(fp)]!.id, by])),
  });
  const followers = (list: Followers) =>
    list.map(([point, leader, share]) => ({ point: featurePoints[point]!.id, leader: featurePoints[leader]!.id, share }));
  return {
    fapu: Object.fromEntries(rigFapus.map((unit, i) => [unit, rig.fapu[i]])),
    eye_pivots: rig.eye_pivot,
    head_pivot: rig.head_pivot,
    irises: rig.irises,
    tongue: rig.tongue,
    lids: rig.lids,
    companions: followers(rig.companions),
    lower_lip: followers(rig.lower_lip),
    viseme_share: rig.viseme_share,
    visemes: rig.visemes.map(named),
    expressions: rig.expressions.map(named),
  } as unknown as RigDocument;
}

function meshOf({ face }: Golden): GoldenMesh {
  const offsets = [0];
  for (const row of face.rows) offsets.push(offsets.at(-1)! + row.length);
  return {
    positions: face.rest.flat(),
    normals: face.normals.map((n) => n.map((x) => x / Math.hypot(...n))).flat(),
    indices: face.triangles.flat(),
    rowOffsets: offsets,
    rowPoints: face.rows.flat().map(([point]) => point),
    rowWeights: face.rows.flat().map(([, weight]) => weight),
    rigid: face.rigid,
    turn: face.turn,
  };
}

/** The poses of all cases, then of all interpolations, computed by the kernel as the shader's input. */
async function poses(): Promise<Record<keyof Pose, number[]>[]> {
  const wasm = join(process.env['SEMBLANTE_WASM'] ?? join(buildDir, 'wasm'), 'semblante_view.wasm');
  expect(existsSync(wasm), wasm).toBe(true);
  const face = { rig: rigOf(golden) } as Face;
  const count = golden.cases.length;
  const kernel = new Kernel(await Runtime.load(() => readFileSync(wasm)), face, {
    poseCount: count + golden.interpolations.length,
    withVertices: false,
  });
  golden.cases.forEach(({ frame: { viseme, expression, faps }, jaw_takes_lip }, pose) => {
    kernel.setJawTakesLip(jaw_takes_lip ?? false);
    const frame = { ...neutralFrame(), viseme, expression };
    const steps = new Float64Array(69).fill(1);
    for (const [fap, value] of Object.entries(faps)) {
      frame.levels[Number(fap)] = 1;
      steps[Number(fap)] = value;
    }
    kernel.evaluate(frame, pose, steps);
  });
  golden.interpolations.forEach(({ from, to, t }, i) => kernel.interpolate(from, to, t, count + i));
  return kernel.poses.map(
    (pose) =>
      Object.fromEntries(Object.entries(pose).map(([name, values]) => [name, Array.from(values as Float32Array)])) as Record<
        keyof Pose,
        number[]
      >,
  );
}

useBrowser();

test('Shader_GoldenFrames_GiveTheGoldenVertices', async () => {
  const bundle = await build({
    entryPoints: [here('support/golden_page.ts')],
    bundle: true,
    write: false,
    format: 'iife',
    nodePaths: [here('../../web/node_modules')],
    alias: { '@client': here('../../clients/js') },
  });
  const page = await browser.newPage();
  page.setDefaultTimeout(patience);
  const errors: string[] = [];
  page.on('console', (message) => void (message.type() === 'error' && errors.push(message.text())));
  page.on('pageerror', (error) => errors.push(String(error)));
  await page.addScriptTag({ content: bundle.outputFiles[0]!.text });
  const found = await page.evaluate(
    ([mesh, all]) =>
      (window as unknown as { deformAll(mesh: unknown, poses: unknown): number[][] }).deformAll(mesh, all),
    [meshOf(golden), await poses()] as const,
  );
  expect(errors).toEqual([]);
  const expected = [...golden.cases, ...golden.interpolations];
  expect(found.length).toBe(expected.length);
  expected.forEach(({ positions, ...rest }, i) => {
    const worst = Math.max(...positions.map((x, k) => Math.abs(x - found[i]![k]!)));
    expect(worst, 'name' in rest ? rest.name : `${rest.from} to ${rest.to}`).toBeLessThanOrEqual(golden.tolerance.position);
  });
});

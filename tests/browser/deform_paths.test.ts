import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { faces } from './support/paths.ts';
import { eventually } from './support/patience.ts';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

/**
 * Tolerance of shader against kernel, in diagonals of the head. Two float32 sums of at most 17 terms in different
 * order, then two rotations: 1e-5 is about ten times the possible difference, and far below what is visible.
 */
const positionTolerance = 1e-5;
/** Tolerance of the shader's normals against the same formula in double precision, degrees. */
const normalTolerance = 0.1;
/** Mean difference over the skin between normals from the weights' slopes and those of the triangles, degrees. */
const meanSlopeError = 6;

interface Comparison {
  worstPosition: number;
  worstNormal: number;
  meanAgainstTriangles: number;
  moved: number;
}

useStudio({ demo: false });

type Edit = { viseme?: number; expression?: number; faps?: Record<number, number> };

const frames: Record<string, Edit> = {
  neutral: {},
  viseme: { viseme: 10 },
  expression: { expression: 1 },
  'viseme and expression': { viseme: 13, expression: 6 },
  'jaw, lids, brows': { faps: { 3: 150, 19: 900, 20: 900, 31: 300, 32: 300, 6: 100 } },
  'one pupil wide, one narrow, looking aside': { faps: { 23: 150, 24: 150, 29: 300, 30: -250 } },
  'jaw and rolled tongue': { faps: { 3: 150, 47: 170 } },
  'gaze and head': { faps: { 23: 150, 24: 150, 25: -60, 26: -60, 48: 80, 49: -150, 50: 60 } },
};

/** Compares, in the page, the same pose deformed by shader and kernel. */
async function compare(studio: StudioPage, edit: Edit): Promise<Comparison> {
  return studio.page.evaluate((change) => {
    const { compareDeformation } = (window as unknown as { semblante: { compareDeformation(edit: Edit): Comparison } })
      .semblante;
    return compareDeformation(change);
  }, edit);
}

async function check(studio: StudioPage): Promise<void> {
  for (const [name, edit] of Object.entries(frames)) {
    const result = await compare(studio, edit);
    expect(result.worstPosition, name).toBeLessThan(positionTolerance);
    expect(result.worstNormal, name).toBeLessThan(normalTolerance);
    expect(result.meanAgainstTriangles, name).toBeLessThan(meanSlopeError);
    if (name === 'neutral') expect(result.moved, name).toBe(0);
    else expect(result.moved, name).toBeGreaterThan(0.002);
  }
}

describe('deformation', () => {
  test('Shader_SampleHead_AgreesWithTheKernel', async () => {
    const studio = await StudioPage.open(browser, server.url, { sharp: true });
    await studio.waitForStage('ready');
    await check(studio);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test.skipIf(faces === null)('Shader_IctHead_AgreesWithTheKernel', async () => {
    const folder = join(faces!, 'ict-facekit');
    const answer = await fetch(`${server.url}/v1/models?name=ict&filename=neutral.obj`, {
      method: 'POST',
      headers: { 'Content-Type': 'model/obj' },
      body: readFileSync(join(folder, 'neutral.obj')),
    });
    const { model } = (await answer.json()) as { model: { id: string } };
    const state = async (): Promise<string> =>
      ((await (await fetch(`${server.url}/v1/models/${model.id}`)).json()) as { state: string }).state;
    const until = (wanted: string): Promise<void> =>
      eventually(`the head is ${wanted}`, async () => (await state()) === wanted);
    await until('ready');
    const put = await fetch(`${server.url}/v1/models/${model.id}/feature-points`, {
      method: 'PUT',
      headers: { 'Content-Type': 'application/json' },
      body: readFileSync(join(folder, 'ict-facekit.fps.json')),
    });
    expect(put.status).toBeLessThan(300);
    await fetch(`${server.url}/v1/models/${model.id}/parametrizations`, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: '{}',
    });
    await until('parametrized');

    const studio = await StudioPage.open(browser, `${server.url}/#${model.id}`, { sharp: true });
    await studio.waitForStage('ready');
    await check(studio);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

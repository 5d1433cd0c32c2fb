import type { Page } from 'playwright-core';
import { beforeAll, describe, expect, test } from 'vitest';
import { eventually } from './support/patience.ts';
import { phone, StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

/** Gives the sample head weights of this kind, and a level of detail. */
async function parametrize(weights: string): Promise<void> {
  const answer = await fetch(`${server.url}/v1/models/sample/parametrizations`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify({ weights, metric: 'edge', lods: [1500] }),
  });
  const { id } = (await answer.json()) as { id: string };
  await eventually('the sample head is parametrized', async () => {
    const { state } = (await (await fetch(`${server.url}/v1/jobs/${id}`)).json()) as { state: string };
    return state === 'done';
  });
}

useStudio();
beforeAll(async () => {
  await parametrize('smooth');
});

interface Compared {
  /** Where the cameras are, in radii of their heads from the middle of them. */
  cameras: [number[], number[]];
  /** Displacements of the feature points. */
  poses: [number[], number[]];
  vertices: [number, number];
  painted: [boolean, boolean];
  /** The sum of all weights. */
  weights: [number, number];
}

/** Both views as they are within one frame. */
function compared(page: Page): Promise<Compared> {
  return page.evaluate(async () => {
    await new Promise(requestAnimationFrame);
    const { scene } = (window as unknown as Inside).semblante;
    type Scene = typeof scene;
    const both = <T>(read: (one: Scene) => T): [T, T] => [read(scene), read((scene as unknown as { twin: Scene }).twin)];
    return {
      cameras: both(({ stage }) => {
        const { camera, center, headRadius } = stage as unknown as {
          camera: { position: { toArray(): number[] } };
          center: { toArray(): number[] };
          headRadius: number;
        };
        const middle = center.toArray();
        return camera.position.toArray().map((value, i) => (value - middle[i]!) / headRadius);
      }),
      poses: both(({ performer }) => Array.from((performer.value as unknown as { pose: { featurePoints: Float32Array } }).pose.featurePoints)),
      vertices: both(({ face }) => face!.mesh.vertexCount),
      painted: both((one) => (one as unknown as { influence: { on: boolean } | null }).influence?.on ?? false),
      weights: both(({ face }) => face!.mesh.rowWeights.reduce((sum, weight) => sum + weight, 0)),
    };
  });
}

const apart = ([a, b]: [number[], number[]]): number => Math.max(...a.map((value, i) => Math.abs(value - b[i]!)));

/** Waits until the second view has its face. */
async function untilBeside(page: Page): Promise<void> {
  await page.waitForFunction(() => {
    const { twin } = (window as unknown as { semblante: { scene: { twin: Inside['semblante']['scene'] | null } } }).semblante.scene;
    return twin?.state.value.kind === 'ready';
  });
}

/** Waits until neither cameras nor faces move. */
async function untilAtRest(page: Page): Promise<void> {
  let last = '';
  await eventually('both views are at rest', async () => {
    const { cameras, poses } = await compared(page);
    const now = JSON.stringify([cameras, poses]);
    const rests = now === last;
    last = now;
    return rests;
  });
}

async function open(): Promise<StudioPage> {
  const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 1100, height: 600 });
  await studio.waitForStage('ready');
  return studio;
}

describe('side by side', () => {
  test('Compare_AnotherLevel_HasTheSameCameraFrameAndColours', async () => {
    const studio = await open();
    const { page } = studio;
    await page.locator('#compare-with').selectOption('level 1');
    await untilBeside(page);
    // The demo moves both, at the same moment of the stream.
    let moved = 0;
    for (let last = (await compared(page)).poses[1]; moved < 5; ) {
      const { poses } = await compared(page);
      if (apart([last, poses[1]]) === 0) continue;
      moved += 1;
      last = poses[1];
      expect(apart(poses)).toBeLessThan(1e-6);
    }
    await page.evaluate(() => (window as unknown as Inside).semblante.driver.byHand());
    const [wide, beside] = [page.locator('canvas.canvas'), page.locator('canvas.twin-canvas')];
    const boxes = [(await wide.boundingBox())!, (await beside.boundingBox())!];
    expect(Math.abs(boxes[0]!.width - boxes[1]!.width)).toBeLessThan(3);
    expect(boxes[1]!.x).toBeGreaterThan(boxes[0]!.x + boxes[0]!.width - 3);
    await untilAtRest(page);
    const first = await compared(page);
    expect(first.vertices[1]).toBeLessThan(first.vertices[0] / 2);
    expect(apart(first.cameras)).toBeLessThan(1e-3);

    // A drag on either view turns both.
    for (const canvas of [wide, beside]) {
      const before = (await compared(page)).cameras[0];
      const { x, y, width, height } = (await canvas.boundingBox())!;
      await page.mouse.move(x + width / 2, y + height / 2);
      await page.mouse.down();
      await page.mouse.move(x + width / 2 + 90, y + height / 2, { steps: 4 });
      await page.mouse.up();
      await untilAtRest(page);
      const { cameras } = await compared(page);
      expect(apart([before, cameras[0]])).toBeGreaterThan(0.5);
      expect(apart(cameras)).toBeLessThan(1e-3);
    }
    // The key of the first view after a drag on the second: the first leads again.
    await wide.focus();
    await page.keyboard.press('1');
    await untilAtRest(page);
    const front = (await compared(page)).cameras;
    expect(Math.abs(front[0][0]!)).toBeLessThan(0.05);
    expect(apart(front)).toBeLessThan(1e-3);

    const still = await compared(page);
    const group = page.locator('[data-group="4"]');
    await group.locator('summary').click();
    await group.locator('input[type=range]').nth(2).fill('350');
    await untilAtRest(page);
    const raised = await compared(page);
    expect(apart([still.poses[1], raised.poses[1]])).toBeGreaterThan(0);
    expect(apart(raised.poses)).toBe(0);

    expect(raised.painted).toEqual([false, false]);
    const unpainted = await studio.seen(() => beside.screenshot());
    await page.locator('#influence-view').check();
    expect((await compared(page)).painted).toEqual([true, true]);
    await studio.drawn(3);
    expect(await studio.difference(unpainted, await studio.seen(() => beside.screenshot()), [0.25, 0.2, 0.5, 0.6])).toBeGreaterThan(3);

    // A playing cue moves both, also in the same frame.
    await page.getByRole('button', { name: 'New performance' }).click();
    await page.getByLabel('Kind of cue').selectOption('viseme-10');
    await page.getByRole('button', { name: 'Add here' }).click();
    await page.getByLabel('To, s').fill('6');
    await page.getByLabel('To, s').press('Enter');
    await page.getByRole('button', { name: 'Play', exact: true }).first().click();
    await eventually('the cue moves both faces', async () => {
      const { poses } = await compared(page);
      expect(apart(poses)).toBe(0);
      return apart([still.poses[1], poses[1]]) > 0;
    });

    // The still model of the points has no second view; it comes back with the face.
    await page.locator('#tab-points').click();
    await beside.waitFor({ state: 'hidden' });
    await page.locator('#tab-animate').click();
    await beside.waitFor();

    // By keyboard: to the button of the second view, and away.
    await page.getByRole('button', { name: 'Close the second view' }).focus();
    await page.keyboard.press('Enter');
    await beside.waitFor({ state: 'detached' });
    expect(await page.evaluate(() => document.activeElement?.id)).toBe('compare-with');
    expect((await wide.boundingBox())!.width).toBeGreaterThan(boxes[0]!.width * 1.9);
    expect(studio.errors.filter((error) => !error.includes('Context Lost'))).toEqual([]);
    await studio.close();
  });

  test('Compare_OtherWeights_AreComputedAndThePresentStayBeside', async () => {
    const studio = await open();
    const { page } = studio;
    await page.locator('#compare-with').selectOption('method paper edge');
    await page.getByText('The server has one set of weights per head').waitFor();
    expect(await page.locator('canvas.twin-canvas').count()).toBe(0); // nothing happens before the button
    await page.getByRole('button', { name: 'Parametrize again and compare' }).click();
    const label = page.locator('.stage-holder .compare-label');
    await label.getByText('As in the paper, along edges').waitFor();
    await page.locator('.compare-view .compare-label').getByText('Smooth skin, along edges').waitFor();
    await eventually('the first view has the new weights', async () => {
      const { weights } = await compared(page);
      return Math.abs(weights[0] - weights[1]) > 1e-3 * weights[1];
    });
    const { package: made } = (await (await fetch(`${server.url}/v1/models/sample`)).json()) as {
      package: { weights: string; levels: unknown[] };
    };
    expect(made.weights).toBe('paper');
    expect(made.levels.length).toBe(2); // as before
    // The former weights can be chosen again.
    expect(await page.locator('#compare-with option[value="method smooth edge"]').count()).toBe(1);
    expect(await page.locator('#compare-with option[value="method paper edge"]').count()).toBe(0);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Compare_OnAPhone_StandsSideBySide_WithShortLabels_AndLeavesTheFacesRoom', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { ...phone });
    await studio.waitForStage('ready');
    const { page } = studio;
    await page.locator('#compare-with').selectOption('level 1');
    await untilBeside(page);
    const [left, right] = [(await page.locator('canvas.canvas').boundingBox())!, (await page.locator('canvas.twin-canvas').boundingBox())!];
    expect(right.x).toBeGreaterThanOrEqual(left.x + left.width - 2);
    expect(Math.abs(right.width - left.width)).toBeLessThan(3);
    expect(left.height).toBeGreaterThan(400);
    // Each label is over its own view, above a place for the face that is higher than wide.
    const tools = (await page.locator('.stage-holder .tools').boundingBox())!;
    for (const [view, box] of [['.stage-holder', left], ['.compare-view', right]] as const) {
      const label = (await page.locator(`${view} .compare-label`).boundingBox())!;
      expect(label.x, view).toBeGreaterThanOrEqual(box.x);
      expect(label.x + label.width, view).toBeLessThanOrEqual(box.x + box.width + 1);
      expect(tools.y - label.y - label.height, view).toBeGreaterThan(box.width);
    }
    expect(await page.locator('.stage-holder .compare-label').innerText()).toMatch(/^Full mesh, [\d,]+ vertices$/);
    expect(await page.locator('.compare-view .compare-text').innerText()).toMatch(/^Level 1, [\d,]+ vertices$/);
    await studio.keep('compare-narrow');
    expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBe(0);
    await page.getByRole('button', { name: 'Close the second view' }).tap();
    await page.locator('canvas.twin-canvas').waitFor({ state: 'detached' });
    expect(studio.errors.filter((error) => !error.includes('Context Lost'))).toEqual([]);
    await studio.close();
  });
});

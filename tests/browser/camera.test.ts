import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { samplePoints } from './support/paths.ts';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

const known = (
  JSON.parse(readFileSync(samplePoints, 'utf8')) as { points: Record<string, { position: [number, number, number] }> }
).points;

useStudio({ demo: false });

/** Where a position of the head is in the picture: 0 to 1 from the upper left. */
async function inPicture(studio: StudioPage, position: readonly number[]): Promise<{ x: number; y: number }> {
  const at = await studio.project(position);
  const box = (await studio.page.locator('canvas.canvas').boundingBox())!;
  return { x: (at.x - box.x) / box.width, y: (at.y - box.y) / box.height };
}

/** The height of the face in the picture, from the chin to the top of the skull, as a part of the picture's height. */
async function faceHeight(studio: StudioPage): Promise<number> {
  const [top, chin] = [await inPicture(studio, known['11.4']!.position), await inPicture(studio, known['2.1']!.position)];
  return chin.y - top.y;
}

/** How far the head's surface under the middle of the picture is from a position, in parts of the head's height. */
function missed(studio: StudioPage, position: readonly number[], height: number): Promise<number> {
  return studio.page.evaluate(
    ({ at, scale }) => {
      const { scene } = (window as unknown as { semblante: { scene: Scene } }).semblante;
      const seen = scene.preview.pick(0, 0, scene.stage.camera)?.position;
      return seen ? Math.hypot(...seen.map((value, axis) => value - at[axis]!)) / scale : Infinity;
    },
    { at: position, scale: height },
  );
}

interface Scene {
  preview: { pick(x: number, y: number, camera: unknown): { position: [number, number, number] } | null };
  stage: { camera: { position: { toArray(): number[] } } };
}

const camera = (studio: StudioPage): Promise<number[]> =>
  studio.page.evaluate(() =>
    (window as unknown as { semblante: { scene: Scene } }).semblante.scene.stage.camera.position.toArray(),
  );

describe('camera', () => {
  test('Camera_ChosenPoint_IsSeenFromInFrontOfItAndTheFaceStaysLarge', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/points?point=10.3`, { width: 1280, height: 720 });
    const { page } = studio;
    await studio.waitForStage('ready');
    const height = known['11.4']!.position[1]! - known['2.1']!.position[1]!;
    // The address alone, then the list: an ear, a cheek, the mouth, the back of the head.
    for (const id of ['10.3', '5.2', '8.3', '11.6']) {
      if (id !== '10.3') await page.locator(`[data-point="${id}"]`).click();
      await page.locator(`[data-point="${id}"][aria-pressed=true]`).waitFor();
      await page.waitForFunction((at) => {
        const { scene } = (window as unknown as { semblante: { scene: Scene } }).semblante;
        const seen = scene.preview.pick(0, 0, scene.stage.camera)?.position;
        return seen !== undefined && Math.hypot(...seen.map((value, axis) => value - at[axis]!)) < 0.03;
      }, known[id]!.position);
      const place = await inPicture(studio, known[id]!.position);
      expect(Math.hypot(place.x - 0.5, place.y - 0.5), id).toBeLessThan(0.02);
      expect(await missed(studio, known[id]!.position, height), id).toBeLessThan(0.05);
      expect(await faceHeight(studio), id).toBeGreaterThan(0.5);
    }
    await studio.keep('camera-point');

    // A point that is chosen on the head is where the eye is already: the camera stays.
    await page.locator('[data-point="11.6"]').click();
    await page.locator('canvas.canvas').focus();
    await page.keyboard.press('1');
    const before = await camera(studio);
    const chin = await studio.project(known['2.1']!.position);
    await page.mouse.click(chin.x, chin.y);
    await page.locator('[data-point="2.1"][aria-pressed=true]').waitFor();
    expect(await camera(studio)).toEqual(before);

    // One key shows the face again; another tab the view before.
    await page.locator('[data-point="8.3"]').click();
    await page.locator('canvas.canvas').focus();
    await page.keyboard.press('f');
    expect(await faceHeight(studio)).toBeGreaterThan(0.5);
    for (const id of ['2.1', '11.4', '10.3', '10.4']) {
      const { x, y } = await inPicture(studio, known[id]!.position);
      expect(Math.max(Math.abs(x - 0.5), Math.abs(y - 0.5)), id).toBeLessThan(0.5);
    }
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Camera_WithoutReducedMotion_Flies', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/points`, { width: 900, motion: 'no-preference', lively: true });
    await studio.waitForStage('ready');
    await studio.page.getByRole('button', { name: 'All 84' }).click();
    // Choosing and looking are one step of the page: no frame is drawn between.
    const [first, next] = await studio.page.evaluate(() => {
      const { scene } = (window as unknown as { semblante: { scene: Scene } }).semblante;
      const from = scene.stage.camera.position.toArray();
      document.querySelector<HTMLElement>('[data-point="10.3"]')!.click();
      return [from, scene.stage.camera.position.toArray()];
    });
    expect(next).toEqual(first);
    await studio.page.waitForFunction((at) => {
      const { scene } = (window as unknown as { semblante: { scene: Scene } }).semblante;
      const seen = scene.preview.pick(0, 0, scene.stage.camera)?.position;
      return seen !== undefined && Math.hypot(...seen.map((value, axis) => value - at[axis]!)) < 0.03;
    }, known['10.3']!.position);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

import { describe, expect, test } from 'vitest';
import { eventually } from './support/patience.ts';
import { phone, StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });

/** Opens the sample with its influence view, the face at rest in the hand. */
async function open(options: { width?: number; height?: number; dark?: boolean } = {}): Promise<StudioPage> {
  const studio = await StudioPage.open(browser, server.url, { width: 1100, height: 720, ...options });
  await studio.waitForStage('ready');
  await studio.page.evaluate(() => (window as unknown as Inside).semblante.driver.byHand());
  await studio.page.locator('#influence-view').check();
  await studio.page.getByRole('button', { name: 'Front', exact: true }).click(); // both sides of the face are seen
  return studio;
}

interface Spot {
  x: number;
  y: number;
  /** The vertex there, and the strongest point and weight of its row of the table. */
  vertex: number;
  point: string;
  percent: number;
}

/** Where a feature point is on the moved face, page coordinates, and the row of the table of its vertex. */
function spotOf(studio: StudioPage, id: string): Promise<Spot> {
  return studio.page.evaluate((wanted) => {
    const { scene } = (window as unknown as Inside).semblante;
    const performer = scene.performer.value!;
    performer.kernel.deform(performer.poseNumber);
    const { mesh } = scene.face!;
    const { vertex } = scene.rig!.feature_points.find((point) => point.id === wanted)!;
    const canvas = document.querySelector('canvas.canvas')!.getBoundingClientRect();
    const at = Array.from(performer.kernel.positions.subarray(vertex! * 3, vertex! * 3 + 3));
    const place = scene.markers.project(at, scene.stage.camera, canvas.width, canvas.height);
    let best = mesh.rowOffsets[vertex!]!;
    for (let k = best; k < mesh.rowOffsets[vertex! + 1]!; k += 1) if (mesh.rowWeights[k]! > mesh.rowWeights[best]!) best = k;
    return {
      x: canvas.left + place.x,
      y: canvas.top + place.y,
      vertex: vertex!,
      point: wanted,
      percent: Math.round(mesh.rowWeights[best]! * 100),
    };
  }, id);
}

/** The colour of the stage at a place of the page, 0..255. */
async function colourAt(studio: StudioPage, { x, y }: { x: number; y: number }): Promise<number[]> {
  await studio.page.mouse.move(1, 1); // the read-out beside the pointer would cover it
  await studio.page.locator('.reading').waitFor({ state: 'hidden' });
  await studio.drawn(3);
  const clip = { x: Math.round(x) - 1, y: Math.round(y) - 1, width: 3, height: 3 };
  const shot = (await studio.seen(() => studio.page.screenshot({ clip }))).toString('base64');
  return studio.page.evaluate(async (png) => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(png), (c) => c.charCodeAt(0))], { type: 'image/png' }));
    const context = new OffscreenCanvas(3, 3).getContext('2d')!;
    context.drawImage(image, 0, 0);
    return Array.from(context.getImageData(1, 1, 1, 1).data.slice(0, 3));
  }, shot);
}

const spread = (colour: number[]): number => Math.max(...colour) - Math.min(...colour);
/** Beside a disc, toward the middle of the face. */
const beside = (spot: Spot, right: number, down = 0): { x: number; y: number } => ({ x: spot.x + right, y: spot.y + down });

describe('influence', () => {
  test('Influence_Heat_ColoursTheRegionOfThePointOnly', async () => {
    const studio = await open();
    const { page } = studio;
    const left = await spotOf(studio, '8.3');
    const right = await spotOf(studio, '8.4');
    // Point 8.3 is chosen when the view opens: its region has colours, and the other corner of the mouth is grey.
    await page.locator('.legend').getByText('Point 8.3').waitFor();
    for (const number of ['0 %', '25 %', '50 %', '75 %', '100 %'])
      expect(await page.locator('.legend-numbers').innerText()).toContain(number);
    expect(spread(await colourAt(studio, beside(left, 11)))).toBeGreaterThan(40);
    expect(spread(await colourAt(studio, beside(right, -11)))).toBeLessThan(20);

    await page.mouse.click(right.x, right.y);
    await page.locator('.legend').getByText('Point 8.4').waitFor();
    expect(spread(await colourAt(studio, beside(right, -11)))).toBeGreaterThan(40);
    expect(spread(await colourAt(studio, beside(left, 11)))).toBeLessThan(20);

    await page.keyboard.down('Shift');
    await page.mouse.click(left.x, left.y);
    await page.keyboard.up('Shift');
    await page.locator('.legend').getByText('2 points together').waitFor();
    expect(await page.locator('.chip').count()).toBe(2);
    expect(spread(await colourAt(studio, beside(left, 11)))).toBeGreaterThan(40);

    await page.locator('#influence-view').uncheck();
    expect(await page.locator('.legend').isVisible()).toBe(false);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Influence_Pointer_ReadsTheWeightsOfTheMovedFace', async () => {
    const studio = await open();
    const { page } = studio;
    const reading = page.locator('.reading');
    const chin = await spotOf(studio, '2.1');
    await page.mouse.move(chin.x, chin.y - 2);
    await reading.waitFor();
    const atRest = await spotOf(studio, '4.3');
    await page.mouse.move(atRest.x, atRest.y);
    await reading.getByText(`Vertex ${atRest.vertex.toLocaleString('en-US')}`, { exact: true }).waitFor();
    expect(await reading.locator('.reading-row').first().innerText()).toContain(`${atRest.percent} %`);
    expect(await reading.locator('.reading-row').first().innerText()).toContain('4.3');

    // The brow is raised by more than its own size, and is read where it is now.
    const group = page.locator('[data-group="4"]');
    await group.locator('summary').click();
    await group.locator('input[type=range]').nth(2).fill('350');
    await eventually('the brow has risen', async () => (await spotOf(studio, '4.3')).y < atRest.y - 5);
    await studio.pictureAtRest();
    const raised = await spotOf(studio, '4.3');
    await page.mouse.move(raised.x, raised.y);
    await reading.getByText(`Vertex ${atRest.vertex.toLocaleString('en-US')}`, { exact: true }).waitFor();
    await page.mouse.move(raised.x, 60);
    await reading.waitFor({ state: 'hidden' });
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Influence_FapSlider_LightsItsPointsAndTheirReach', async () => {
    const studio = await open();
    const { page } = studio;
    const group = page.locator('[data-group="4"]');
    await group.locator('summary').click();
    await page.locator('[data-mode=uncovered]').click();
    await group.locator('input[type=range]').nth(2).fill('300');
    await page.locator('.legend').getByText('FAP 33').waitFor();
    // Left and right move together: the points of both, and their reach in the heat map.
    expect(await page.locator('.chip').evaluateAll((chips) => chips.map((chip) => chip.getAttribute('data-point')))).toEqual(['4.3', '4.4']);
    await studio.pictureAtRest();
    expect(spread(await colourAt(studio, beside(await spotOf(studio, '4.3'), 11)))).toBeGreaterThan(40);
    expect(spread(await colourAt(studio, beside(await spotOf(studio, '4.4'), -11)))).toBeGreaterThan(40);
    expect(spread(await colourAt(studio, beside(await spotOf(studio, '8.3'), 11)))).toBeLessThan(20);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Influence_RegionsStrongestAndUncovered_AreTheirColours', async () => {
    const studio = await open();
    const { page } = studio;
    await page.locator('[data-mode=regions]').click();
    await page.selectOption('#influence-point', '4.3'); // after 8.3
    await page.selectOption('#influence-point', '4.4');
    const left = await colourAt(studio, beside(await spotOf(studio, '4.3'), 0, -12));
    const right = await colourAt(studio, beside(await spotOf(studio, '4.4'), 0, -12));
    expect(left[2]! - left[0]!).toBeGreaterThan(30); // sky blue, the second colour
    expect(right[1]! - right[0]!).toBeGreaterThan(30); // green, the third
    await page.locator('[data-mode=strongest]').click();
    const brow = await colourAt(studio, beside(await spotOf(studio, '4.3'), 11));
    expect(spread(brow)).toBeGreaterThan(40);
    await page.locator('[data-mode=uncovered]').click();
    const covered = await colourAt(studio, beside(await spotOf(studio, '4.3'), 11));
    expect(covered[2]! - covered[0]!).toBeGreaterThan(15); // blue: the skin of the face is covered
    const words = await page.locator('.legend').innerText();
    expect(words).toMatch(/No point\s+[\d,]+ · \d+ %/);
    expect(words).toMatch(/Covered\s+[\d,]+ · \d+ %/);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Influence_KernelPath_PaintsAndMovesTheSame', async () => {
    const studio = await open();
    const { page } = studio;
    const group = page.locator('[data-group="4"]');
    await group.locator('summary').click();
    await group.locator('input[type=range]').nth(2).fill('300');
    const gpu = await studio.pictureAtRest();
    await page.getByRole('button', { name: 'Deform on the GPU' }).click();
    const wasm = await studio.pictureAtRest();
    // Tools and legend are not in the region; the discs of the points are.
    expect(await studio.difference(gpu, wasm, [0.25, 0.1, 0.5, 0.7])).toBeLessThan(0.3);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Influence_KeyboardOnly_SwitchesChoosesAndReads', async () => {
    const studio = await StudioPage.open(browser, server.url, { width: 1100, height: 720 });
    await studio.waitForStage('ready');
    const { page } = studio;
    await page.locator('#influence-view').focus();
    await page.keyboard.press('Space');
    await page.locator('.legend').waitFor();
    await page.keyboard.press('Tab');
    await page.keyboard.press('Tab');
    await page.keyboard.press('Enter'); // Regions
    await page.locator('.legend').getByText('Regions').waitFor();
    await page.locator('[data-focus="chip-8.3"]').focus();
    await page.keyboard.press('Enter');
    expect(await page.locator('.chip').count()).toBe(0);
    await page.locator('canvas.canvas').focus();
    await page.keyboard.press('i');
    const said = await page.getByRole('status').filter({ hasText: /^Vertex/ }).textContent();
    expect(said).toMatch(/^Vertex \d+ follows (\d+\.\d+ .+ by (< )?\d+ %|no feature point)/);
    await page.locator('.reading').waitFor();
    await page.keyboard.press('Escape');
    expect(await page.locator('.reading').isVisible()).toBe(false);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Influence_LongPressOnAPhone_ReadsAndNothingOverflows', async () => {
    const studio = await StudioPage.open(browser, server.url, { ...phone });
    await studio.waitForStage('ready');
    const { page } = studio;
    await page.locator('#influence-view').tap();
    await page.locator('.legend').waitFor();
    const brow = await spotOf(studio, '4.3');
    const touch = await studio.context.newCDPSession(page);
    await touch.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x: brow.x, y: brow.y }] });
    await page.locator('.reading').getByText('4.3').first().waitFor();
    await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    // It stays when the finger is gone, within the stage, above where the finger was.
    const [card, stage] = [(await page.locator('.reading').boundingBox())!, (await page.locator('canvas.canvas').boundingBox())!];
    expect(card.x).toBeGreaterThanOrEqual(0);
    expect(card.x + card.width).toBeLessThanOrEqual(390);
    expect(card.y).toBeGreaterThanOrEqual(stage.y);
    for (const mode of ['regions', 'strongest', 'uncovered', 'heat']) {
      await page.locator(`[data-mode=${mode}]`).tap();
      expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBe(0);
    }
    // The units have their names alone, which leaves the small face to be seen; nearer there is room for their values.
    await page.locator('#units-view').tap();
    await studio.drawn(2);
    expect(Math.max(...(await widthsOfUnits(studio)))).toBeLessThan(70);
    await page.locator('canvas.canvas').press('f');
    for (let press = 0; press < 8; press += 1) await page.locator('canvas.canvas').press('+');
    await eventually('the labels have values', async () => Math.min(...(await widthsOfUnits(studio))) > 70);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

/** Widths of the labels of the units, pixels, as they were drawn last. */
const widthsOfUnits = ({ page }: StudioPage): Promise<number[]> =>
  page.evaluate(() => {
    const { scene } = (window as unknown as WithUnits).semblante;
    const pixels = document.querySelector('canvas.canvas')!.clientHeight / (2 * Math.tan((scene.stage.camera.fov * Math.PI) / 360));
    return scene.stage.scene.getObjectsByProperty('isSprite', true).map(({ scale }) => scale.x * pixels);
  });
interface WithUnits {
  semblante: {
    scene: { stage: { camera: { fov: number }; scene: { getObjectsByProperty(name: string, value: boolean): { scale: { x: number } }[] } } };
  };
}

describe('units', () => {
  test('Units_ByHand_AreStoredDrawnAndTakenBack', async () => {
    const studio = await StudioPage.open(browser, server.url, { width: 1100, height: 720 });
    await studio.waitForStage('ready');
    const { page } = studio;
    await page.evaluate(() => (window as unknown as Inside).semblante.driver.byHand());
    const before = await studio.pictureAtRest();
    await page.locator('#units-view').check();
    await studio.pictureUnlike(before, [0.25, 0.2, 0.5, 0.6], 0.2);
    expect(Math.min(...(await widthsOfUnits(studio)))).toBeGreaterThan(70);

    const rig = async (): Promise<Record<string, number>> =>
      ((await (await fetch(`${server.url}/v1/models/sample/rig.json`)).json()) as { fapu: Record<string, number> }).fapu;
    const byHand = async (): Promise<Record<string, number>> =>
      ((await (await fetch(`${server.url}/v1/models/sample/feature-points`)).json()) as { fapu: Record<string, number> }).fapu;
    const measured = (await rig())['MW']! * 1024;
    const input = page.locator('#unit-MW');
    expect(Number(await input.inputValue())).toBeCloseTo(measured, 3);

    await input.fill('0');
    await input.press('Enter');
    await page.getByText('MW is a length').waitFor();
    expect(Number(await input.inputValue())).toBeCloseTo(measured, 3);

    await input.fill(String(measured * 1.5));
    await input.press('Enter');
    await page.getByRole('button', { name: 'by hand', exact: true }).waitFor();
    expect((await byHand())['MW']).toBeCloseTo(measured * 1.5, 4);
    await page.getByText('until it is parametrized again').waitFor();
    await page.locator('.units').getByRole('button', { name: 'Parametrize again' }).click();
    await eventually('the package has the new unit', async () => Math.abs((await rig())['MW']! * 1024 - measured * 1.5) < 1e-3 * measured);
    await page.getByText('until it is parametrized again').waitFor({ state: 'hidden' });

    await page.getByRole('button', { name: 'by hand', exact: true }).click();
    await eventually('no unit is given by hand', async () => (await byHand())['MW'] === undefined);
    await page.getByText('until it is parametrized again').waitFor();
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

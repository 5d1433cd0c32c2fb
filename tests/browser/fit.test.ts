import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { sampleHead, samplePoints } from './support/paths.ts';
import { patience } from './support/patience.ts';
import { StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

interface ModelPart {
  index: number;
  role: string;
  role_by_user: boolean;
  triangles: number;
}

const scratch = mkdtempSync(join(tmpdir(), 'semblante-fit-'));

useStudio({ demo: false });

/** A ball as an OBJ file with one duplicate triangle. */
function damagedBall(): string {
  const rings = 8;
  const around = 12;
  const lines: string[] = [];
  for (let i = 0; i <= rings; i += 1) {
    for (let k = 0; k < around; k += 1) {
      const [theta, phi] = [(Math.PI * i) / rings, (2 * Math.PI * k) / around];
      const r = Math.max(Math.sin(theta), 0.01);
      lines.push(`v ${r * Math.cos(phi)} ${Math.cos(theta)} ${r * Math.sin(phi)}`);
    }
  }
  const at = (i: number, k: number): number => i * around + (k % around) + 1;
  for (let i = 0; i < rings; i += 1)
    for (let k = 0; k < around; k += 1)
      lines.push(
        `f ${at(i, k)} ${at(i, k + 1)} ${at(i + 1, k + 1)}`,
        `f ${at(i, k)} ${at(i + 1, k + 1)} ${at(i + 1, k)}`,
      );
  lines.push(`f ${at(4, 3)} ${at(4, 4)} ${at(5, 4)}`);
  const path = join(scratch, 'damaged.obj');
  writeFileSync(path, `${lines.join('\n')}\n`);
  return path;
}

const camera = (studio: StudioPage): Promise<number[]> =>
  studio.page.evaluate(() => (window as unknown as Inside).semblante.scene.stage.camera.position.toArray());

/** The highlight on the stage: the triangles of the tinted part and the dots on vertices. */
const pointedOut = (studio: StudioPage): Promise<{ triangles: number; dots: number }> =>
  studio.page.evaluate(() => {
    const { parts, dots } = (window as unknown as Inside).semblante.scene.highlight;
    const corners = parts.children.reduce((sum, { geometry }) => sum + (geometry.index?.count ?? 0), 0);
    // Each part is drawn twice: faintly without depth test, and where it is visible.
    return { triangles: corners / 3 / 2, dots: dots.object.visible ? dots.count : 0 };
  });

describe('fit', () => {
  test('Fit_DamagedMesh_FindingIsShownAndLeadsToItsPlace', async () => {
    const studio = await StudioPage.open(browser, server.url);
    const { page } = studio;
    await studio.waitForStage('ready');
    await studio.drop(damagedBall());
    await studio.waitForState('ready');
    await studio.waitForStage('ready');
    // A head with warnings opens on the Points tab; the badge of the Fit tab has their number.
    await page.locator('#tab-points[aria-selected="true"]').waitFor();
    await page.locator('#tab-fit .finding-badge').click();
    await page.locator('#tab-fit[aria-selected="true"]').waitFor();
    const finding = page.locator('.finding[data-code="duplicate-triangles"]');
    expect(await finding.locator('.finding-words').innerText()).toMatch(/^[A-Z\d].*\.$/);
    expect(await finding.locator('.remedy').innerText()).not.toBe('');
    const before = await camera(studio);
    await finding.locator('.finding-show').click();
    expect((await pointedOut(studio)).dots).toBeGreaterThan(0);
    expect(await camera(studio)).not.toEqual(before);
    expect(await finding.locator('.finding-show').getAttribute('aria-pressed')).toBe('true');
    await finding.locator('.finding-show').click();
    expect((await pointedOut(studio)).dots).toBe(0);
    // On another tab the whole head is in view again.
    await page.locator('#tab-animate').click();
    expect(await camera(studio)).toEqual(before);
    await page.locator('#tab-heads').click();
    expect(await page.locator('.head.selected .finding-badge').innerText()).toMatch(/^\d+/);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Fit_SoundHead_SaysSoAndRolesCanBeCorrected', async () => {
    const studio = await StudioPage.open(browser, server.url);
    const { page } = studio;
    await studio.waitForStage('ready');
    await studio.drop(sampleHead, 'roles.glb');
    await studio.waitForState('ready');
    await studio.waitForStage('ready');
    await page.locator('#tab-fit').click();
    await page.getByText('Nothing found.').waitFor();

    const model = await page.evaluate(() => (window as unknown as Inside).semblante.studio.selected.value!);
    const read = async (): Promise<ModelPart[]> =>
      ((await (await fetch(`${server.url}/v1/models/${model.id}`)).json()) as { parts: ModelPart[] }).parts;
    const tongue = (await read()).find(({ role }) => role === 'tongue')!;
    const row = page.locator(`.fit [data-part="${tongue.index}"]`);
    await row.hover();
    expect((await pointedOut(studio)).triangles).toBe(tongue.triangles);
    await page.locator('h2', { hasText: 'Fit doctor' }).hover();
    expect((await pointedOut(studio)).triangles).toBe(0);

    await row.getByRole('combobox').selectOption('attached');
    await row.getByText('yours').waitFor();
    expect((await read())[tongue.index]).toMatchObject({ role: 'attached', role_by_user: true });
    await row.getByRole('combobox').selectOption({ label: 'Guess again' });
    await row.getByText('guessed').waitFor();
    expect((await read())[tongue.index]).toMatchObject({ role_by_user: false });
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Fit_PointOnTheOtherLip_IsToldWhereTheFaceTalksAndMendedWithOnePress', async () => {
    const { points } = JSON.parse(readFileSync(samplePoints, 'utf8')) as { points: Record<string, { vertex: number | null; position: number[] }> };
    const [upper, lower] = [points['2.6']!.vertex, points['2.8']!.vertex];
    const placed = Object.entries(points)
      .filter(([id]) => id !== '2.8')
      .map(([id, { vertex, position }]) => [id, id === '2.6' ? { vertex: lower } : vertex === null ? { position } : { vertex }] as const);
    const head = { method: 'POST', body: readFileSync(sampleHead), headers: { 'Content-Type': 'model/gltf-binary' } };
    const { model } = (await (await fetch(`${server.url}/v1/models?name=Lips`, head)).json()) as { model: { id: string } };
    const address = `${server.url}/v1/models/${model.id}`;
    await expect.poll(async () => ((await (await fetch(address)).json()) as { state: string }).state, { timeout: patience }).toBe('ready');
    const kept = await fetch(`${address}/feature-points`, { method: 'PUT', headers: { 'Content-Type': 'application/json', 'If-Match': '*' }, body: JSON.stringify({ points: Object.fromEntries(placed) }) });
    expect(kept.status).toBe(200);

    const studio = await StudioPage.open(browser, `${server.url}/#${model.id}/points`);
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.getByRole('button', { name: 'Make it move (parametrize)' }).first().click();
    const notice = page.locator('.notice.errors');
    await notice.getByText('The fit doctor found 1 error: this face moves wrongly in places, or not at all.').waitFor();
    await page.locator('#tab-animate[aria-selected=true]').waitFor();
    await studio.keep('errors-notice');
    await notice.getByRole('button', { name: 'See what is wrong' }).click();
    await page.locator('.finding[data-code="point-on-other-rim"]').waitFor();
    await page.locator('#panel-fit .mend').waitFor();
    await page.locator('#tab-animate').click();
    await notice.getByRole('button', { name: 'Move point 2.6 and parametrize again' }).click();
    await notice.waitFor({ state: 'hidden' });
    await page.locator('#tab-animate[aria-selected=true]').waitFor();
    const now = (await (await fetch(`${address}/feature-points`)).json()) as { points: Record<string, { vertex: number }> };
    expect(now.points['2.6']!.vertex).toBe(upper);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Fit_AxesSaidByHand_HeadIsTurned', async () => {
    const studio = await StudioPage.open(browser, server.url);
    const { page } = studio;
    await studio.waitForStage('ready');
    await studio.drop(sampleHead, 'axes.glb');
    await studio.waitForState('ready');
    await studio.waitForStage('ready');
    await page.locator('#tab-fit').click();
    const axes = page.locator('.frame-facts dd').nth(1);
    await axes.getByText('+Y up, +Z to the front').waitFor();
    const size = page.locator('.frame-facts dd').nth(2);
    const before = (await size.innerText()).split(/ × | cm/);
    const picture = await studio.picture();

    await page.getByLabel('Top of the head').selectOption('+Z');
    // Up and front cannot be the same axis.
    // A press says why, and the button beside it helps.
    await page.getByRole('button', { name: 'Apply' }).click({ force: true });
    await page.getByText('need different axes').waitFor();
    await page.getByRole('button', { name: 'Choose another front' }).click();
    expect(await page.evaluate(() => document.activeElement?.id)).toBe('frame-front');
    await page.getByLabel('Front of the face').selectOption('-Y');
    await page.getByRole('button', { name: 'Apply' }).click();
    // The old axes are shown until the model has been imported again.
    await axes.getByText('+Z up, -Y to the front').waitFor();
    await axes.getByText('yours').waitFor();
    const turned = async (): Promise<unknown> => {
      const after = (await size.innerText()).split(/ × | cm/);
      return [after[0], after[2], after[1]];
    };
    await expect.poll(turned, { timeout: patience }).toEqual(before.slice(0, 3));
    await studio.pictureUnlike(picture, [0.2, 0.2, 0.6, 0.6], 5);
    await studio.waitForStage('ready');

    await page.getByRole('button', { name: 'Guess again' }).click();
    await axes.getByText('+Y up, +Z to the front').waitFor();
    await axes.getByText('guessed').waitFor();
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Levels_OfTheSample_AreListedAndShown', async () => {
    const studio = await StudioPage.open(browser, server.url);
    const { page } = studio;
    await studio.waitForStage('ready');
    const shown = (): Promise<number> =>
      page.evaluate(() => (window as unknown as Inside).semblante.scene.face!.mesh.vertexCount);
    const full = await shown();
    expect(await page.locator('[data-level="0"]').getAttribute('aria-pressed')).toBe('true');
    const level = page.locator('[data-level="1"]');
    await level.scrollIntoViewIfNeeded();
    const words = await level.innerText();
    expect(words).toMatch(/Error at most [\d.]+ % of the eye distance, in expressions [\d.]+ %/);
    await level.click();
    await page.waitForFunction((before) => {
      const { scene } = (window as unknown as Inside).semblante;
      return scene.state.value.kind === 'ready' && (scene.face?.mesh.vertexCount ?? before) < before;
    }, full);
    expect(words).toContain(`${(await shown()).toLocaleString('en-US')} vertices`);
    // The level of detail is animated like the full mesh.
    const before = await studio.pictureAtRest();
    await page.locator('[data-viseme="10"]').click();
    await studio.pictureUnlike(before, [0.3, 0.4, 0.4, 0.4], 0.5);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

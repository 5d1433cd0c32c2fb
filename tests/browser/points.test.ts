import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { quickSet } from '@protocol/generated/mpeg4.ts';
import { sampleHead, samplePoints } from './support/paths.ts';
import { phone, StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

interface Points {
  points: Record<string, { vertex: number; position: [number, number, number]; proposed?: boolean }>;
}

const scratch = mkdtempSync(join(tmpdir(), 'semblante-points-'));
const known = (JSON.parse(readFileSync(samplePoints, 'utf8')) as Points).points;

useStudio({ demo: false });

/** The points of the open head that are stored on the server. */
async function stored(studio: StudioPage): Promise<Points['points']> {
  const id = await studio.page.evaluate(() => (window as unknown as Inside).semblante.studio.selected.value!.id);
  return ((await (await fetch(`${server.url}/v1/models/${id}/feature-points`)).json()) as Points).points;
}

async function openNew(name: string): Promise<StudioPage> {
  const studio = await StudioPage.open(browser, server.url);
  await studio.waitForStage('ready');
  await studio.drop(sampleHead, name);
  await studio.waitForState('ready');
  await studio.waitForStage('ready');
  await studio.page.locator('#tab-points').click();
  return studio;
}

describe('feature points', () => {
  test('Points_OnAPhone_TheButtonThatBeginsIsNotCovered', async () => {
    const studio = await StudioPage.open(browser, server.url, { ...phone });
    const { page } = studio;
    await studio.waitForStage('ready');
    await studio.drop(sampleHead, 'phone.glb');
    await studio.waitForState('ready');
    await studio.waitForStage('ready');
    await page.locator('#tab-points').click();
    const find = page.getByRole('button', { name: 'Find the points' });
    const box = (await find.boundingBox())!;
    const foot = (await page.locator('.points .panel-foot').boundingBox())!;
    await studio.keep('points-phone-start');
    expect(box.y + box.height).toBeLessThanOrEqual(foot.y);

    // The shape of the face shows them: nobody has marked one.
    await find.tap();
    await page.getByRole('button', { name: 'Confirm all' }).waitFor();
    const found = await stored(studio);
    expect(Object.keys(found).length).toBeGreaterThan(75);
    expect(Object.values(found).every((point) => point.proposed)).toBe(true);
    expect(found['3.1']!.vertex).toBe(known['3.1']!.vertex);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Points_ClickJustBesideTheHead_LiesOnItsOutline_FartherOffNowhere', async () => {
    const studio = await openNew('outline.glb');
    const { page } = studio;
    await page.getByRole('button', { name: 'Start', exact: true }).click();
    await page.waitForFunction(() => location.hash.includes('point='));
    await studio.drawn(3);
    /** The highest place of the head in the middle of the picture, CSS pixels. */
    const top = await page.evaluate(() => {
      interface Preview {
        pick(x: number, y: number, camera: unknown): object | null;
      }
      const { scene } = (window as unknown as { semblante: { scene: { preview: Preview; stage: { camera: unknown } } } }).semblante;
      const box = document.querySelector('canvas.canvas')!.getBoundingClientRect();
      let y = 0;
      while (y < box.height && scene.preview.pick(0, 1 - (2 * y) / box.height, scene.stage.camera) === null) y += 1;
      return { x: box.left + box.width / 2, y: box.top + y };
    });
    await page.mouse.click(top.x, top.y - 24);
    await page.getByText(/\b0 of 84 placed/).waitFor();
    await page.mouse.click(top.x, top.y - 7);
    await page.getByText(/\b1 of 84 placed/).waitFor();
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Points_NoneYet_PanelLeadsThroughThemByPointerAndKeyboard', async () => {
    const studio = await openNew('guided.glb');
    const { page } = studio;
    // What can do nothing yet says why, beside what helps.
    const foot = page.locator('.points .panel-foot');
    expect(await foot.getByRole('button', { name: 'Make it move (parametrize)' }).isDisabled()).toBe(true);
    await foot.getByText('A face needs feature points, and none is placed.').waitFor();
    for (const name of ['Fill the missing side by mirroring', 'Export points to a file'])
      expect(await page.getByRole('button', { name }).getAttribute('title'), name).toMatch(/No point is placed yet/);
    // A press says it too, and offers what helps.
    await page.getByRole('button', { name: 'Export points to a file' }).press('Enter');
    await page.locator('.toast').getByText('No point is placed yet.').waitFor();
    expect(await page.evaluate(() => document.activeElement?.textContent)).toBe('Place the first');
    await page.keyboard.press('Enter');
    await page.getByText(`Point 1 of ${quickSet.length}`).waitFor();
    await studio.keep('points-none-yet');
    await foot.getByRole('button', { name: 'Place the first' }).click();
    for (const [i, id] of ['9.3', '9.15', '8.1'].entries()) {
      await page.getByText(`Point ${i + 1} of ${quickSet.length}`).waitFor();
      const spot = await studio.project(known[id]!.position);
      await page.mouse.click(spot.x, spot.y);
    }
    await page.getByText(`Point 4 of ${quickSet.length}`).waitFor();
    await page.getByText('3 of 84 placed').waitFor();
    expect(await foot.getByRole('button', { name: 'Place the first' }).count()).toBe(0);

    // Keyboard only: place the point under the crosshair in the middle of the stage.
    await page.locator('canvas.canvas').focus();
    await page.keyboard.press('Shift+ArrowDown');
    await page.keyboard.press('Space');
    await page.getByText(`Point 5 of ${quickSet.length}`).waitFor();
    await page.keyboard.press('n');
    await page.getByText(`Point 6 of ${quickSet.length}`).waitFor();
    expect(await foot.evaluate((element) => element.scrollWidth - element.clientWidth), 'nothing is cut').toBe(0);
    await page.getByRole('button', { name: 'Save 4 changes' }).click();
    await page.getByRole('button', { name: 'Saved' }).waitFor();
    expect(Object.keys(await stored(studio)).sort()).toEqual(['2.2', '8.1', '9.15', '9.3']);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Points_QuickSet_RestIsProposedLookedOverAndConfirmed', async () => {
    const studio = await openNew('proposed.glb');
    const { page } = studio;
    const file = join(scratch, 'quick.fps.json');
    writeFileSync(
      file,
      JSON.stringify({ points: Object.fromEntries(quickSet.map((id) => [id, { vertex: known[id]!.vertex }])) }),
    );
    await page.setInputFiles('#points-file', file);
    await page.getByText('20 of 84 placed').waitFor();

    // The file is one step back, and so is the other side.
    await page.keyboard.press('Control+z');
    await page.getByText('0 of 84 placed', { exact: true }).waitFor();
    await page.getByRole('button', { name: 'Save 20 changes' }).waitFor();
    await page.keyboard.press('Control+Shift+z');
    await page.getByText('20 of 84 placed').waitFor();
    await page.getByRole('button', { name: 'Saved' }).waitFor();
    await page.getByRole('button', { name: 'Fill the missing side by mirroring' }).click();
    await page.getByText(/^(2[1-9]|3\d) of 84 placed/).waitFor();
    await page.keyboard.press('Control+z');
    await page.getByText('20 of 84 placed').waitFor();

    await page.getByRole('button', { name: 'Propose missing points' }).click();
    const confirmAll = page.getByRole('button', { name: 'Confirm all' });
    await confirmAll.waitFor();
    const count = async (): Promise<number> =>
      Number(/^\d+/.exec(await page.locator('.proposals strong').innerText())![0]);
    const proposed = await count();
    expect(proposed).toBeGreaterThan(40);
    expect(await page.locator('.point-row.proposed').count()).toBe(proposed);

    // The proposals are one step back, and come again.
    await page.keyboard.press('Control+z');
    await page.getByText('20 of 84 placed').waitFor();
    expect(await page.locator('.point-row.proposed').count()).toBe(0);
    await page.keyboard.press('Control+Shift+z');
    await confirmAll.waitFor();
    expect(await count()).toBe(proposed);
    await page.getByRole('button', { name: 'Saved' }).waitFor();

    // One point confirmed, one moved, one removed: none of them is a proposal any more.
    await page.getByRole('button', { name: 'Review' }).click();
    await page.getByRole('button', { name: 'Confirm', exact: true }).click();
    expect(await count()).toBe(proposed - 1);
    const chin = page.locator('[data-point="2.10"]');
    await chin.click();
    const spot = await studio.project(known['2.10']!.position);
    await page.mouse.click(spot.x, spot.y);
    expect(await chin.getAttribute('class')).toContain('changed');
    await page.locator('[data-point="5.1"]').click();
    await page.getByRole('button', { name: 'Remove point 5.1' }).click();
    expect(await count()).toBe(proposed - 3);
    await page.getByRole('button', { name: 'Save 3 changes' }).click();
    await page.getByRole('button', { name: 'Saved' }).waitFor();
    const some = await stored(studio);
    expect(some['5.1']).toBeUndefined();
    expect(some['2.10']!.proposed).toBeUndefined();
    expect(Object.values(some).filter((point) => point.proposed)).toHaveLength(proposed - 3);

    await confirmAll.click();
    await page.getByRole('button', { name: /^Save \d+ changes/ }).click();
    await page.getByRole('button', { name: 'Saved' }).waitFor();
    expect(Object.values(await stored(studio)).filter((point) => point.proposed)).toHaveLength(0);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

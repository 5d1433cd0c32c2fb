import { describe, expect, test } from 'vitest';
import { phone, StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });

interface Page {
  semblante: {
    scene: {
      preview: { pick(x: number, y: number, camera: unknown): { part: number | null } | null };
      stage: { camera: unknown };
    };
    studio: { selected: { value: { parts: { index: number; name: string; role: string }[] } } };
  };
}

/** The name of the part that is seen at a place of the stage, in fractions from its upper left corner; null: none. */
const partAt = ({ page }: StudioPage, x: number, y: number): Promise<string | null> =>
  page.evaluate(
    ([right, down]) => {
      const { scene, studio } = (window as unknown as Page).semblante;
      const part = scene.preview.pick(right * 2 - 1, 1 - down * 2, scene.stage.camera)?.part;
      return studio.selected.value.parts.find(({ index }) => index === part)?.name ?? null;
    },
    [x, y] as const,
  );

const point = async ({ page }: StudioPage, x: number, y: number): Promise<void> => {
  const box = (await page.locator('canvas.canvas').boundingBox())!;
  await page.mouse.move(box.x + box.width * x, box.y + box.height * y);
};

describe('hidden parts', () => {
  test('Parts_KeyAndList_HideWhatIsNotPickedAndAreRemembered', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/points`, { width: 1440, height: 900 });
    const { page } = studio;
    await studio.waitForStage('ready');
    const box = page.locator('.parts-box:not(.scans)');
    const before = await studio.pictureAtRest();
    // The hair, then the skin below it.
    const stage = (await page.locator('canvas.canvas').boundingBox())!;
    const spot = await studio.project([0, 0.1, 0.06]);
    const at = [(spot.x - stage.x) / stage.width, (spot.y - stage.y) / stage.height] as const;
    const hair = await partAt(studio, ...at);
    expect(hair).toBe('hair');
    await point(studio, ...at);
    await page.keyboard.press('h');
    await page.getByText('1 hidden').waitFor();
    const bald = await partAt(studio, ...at);
    expect(bald).toBe('skin');
    expect(await studio.difference(before, await studio.pictureAtRest(), [0.4, at[1] - 0.04, 0.2, 0.08])).toBeGreaterThan(4);
    await box.locator('summary').click();
    const row = box.locator('.eye', { hasText: hair! });
    expect(await row.getAttribute('aria-pressed')).toBe('false');
    await studio.keep('hidden-parts-wide');

    // Kept with the head, also over a reload; the Fit tab shows the whole head.
    await page.reload();
    await studio.waitForStage('ready');
    await page.getByText('1 hidden').waitFor();
    expect(await partAt(studio, ...at)).toBe(bald);
    await page.locator('#tab-fit').click();
    expect(await partAt(studio, ...at)).toBe(hair);
    await page.locator('#tab-points').click();
    expect(await partAt(studio, ...at)).toBe(bald);

    // By keyboard alone: the list is one stop; the row of the hair, a second part at the cross, then all.
    await box.locator('summary').focus();
    await page.keyboard.press('Enter');
    await page.keyboard.press('Tab');
    await page.keyboard.press('Home');
    for (let i = 0; i < 20 && !(await row.evaluate((one) => one === document.activeElement)); i += 1) await page.keyboard.press('ArrowDown');
    await page.keyboard.press('Space');
    expect(await row.getAttribute('aria-pressed')).toBe('true');
    expect(await partAt(studio, ...at)).toBe(hair);
    const middle = await partAt(studio, 0.5, 0.5);
    await page.mouse.move(5, 5);
    await page.locator('canvas.canvas').focus();
    await page.keyboard.press('h');
    await page.getByText('1 hidden').waitFor();
    expect(await partAt(studio, 0.5, 0.5)).not.toBe(middle);
    await page.keyboard.press('Shift+H');
    expect(await partAt(studio, 0.5, 0.5)).toBe(middle);
    expect(await page.evaluate(() => localStorage.getItem('semblante.points.sample'))).toBeNull();
    // A letter that is written is none of it.
    await page.getByRole('button', { name: 'All 84' }).click();
    await point(studio, ...at);
    await page.getByRole('searchbox').fill('');
    await page.getByRole('searchbox').pressSequentially('h');
    expect(await partAt(studio, ...at)).toBe(hair);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Parts_Finger_HidesByTheList', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/points`, { ...phone, locale: 'pt-BR', dark: true });
    const { page } = studio;
    await studio.waitForStage('ready');
    const middle = await partAt(studio, 0.5, 0.5);
    await page.locator('.parts-box:not(.scans) summary').tap();
    await page.locator('.eye', { hasText: middle! }).tap();
    await page.getByText('1 oculta').waitFor();
    expect(await partAt(studio, 0.5, 0.5)).not.toBe(middle);
    await page.locator('.eyes').scrollIntoViewIfNeeded();
    await studio.keep('hidden-parts-narrow');
    await page.getByRole('button', { name: 'Mostrar todas' }).tap();
    expect(await partAt(studio, 0.5, 0.5)).toBe(middle);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

import { describe, expect, test } from 'vitest';
import { phone, StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });

type Position = [number, number, number];

const positionOf = (studio: StudioPage, id: string): Promise<Position | null> =>
  studio.page.evaluate((point) => {
    const { markers } = (window as unknown as { semblante: { scene: { markers: { of(id: string): { position: Position } | null } } } })
      .semblante.scene;
    return markers.of(point)?.position ?? null;
  }, id);

const apart = (a: Position, b: Position): number => Math.hypot(...a.map((value, axis) => value - b[axis]!));
/** The image in the middle plane of the sample head, which is symmetric. */
const image = ([x, y, z]: Position): Position => [-x, y, z];

async function openAt(studio: StudioPage, id: string): Promise<void> {
  await studio.waitForStage('ready');
  await studio.page.waitForFunction(
    (point) =>
      (window as unknown as { semblante: { scene: { markers: { of(id: string): object | null } } } }).semblante.scene.markers.of(point) !== null,
    id,
  );
  await studio.page.locator('.loupe').waitFor({ state: 'attached' });
  await studio.drawn(3);
}

describe('locked pairs', () => {
  test('Lock_Mouse_TakesTheOtherSideAlong_AndAPairCanBeTakenApart', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/points?point=8.3`, { width: 1440, height: 900 });
    const { page } = studio;
    await openAt(studio, '8.3');
    const height = apart((await positionOf(studio, '11.4'))!, (await positionOf(studio, '2.1'))!);
    const [left, right] = [(await positionOf(studio, '8.3'))!, (await positionOf(studio, '8.4'))!];
    const save = page.locator('.points .panel-foot button').first();
    const drag = async (id: string, x: number, y: number, during?: () => Promise<void>): Promise<void> => {
      const at = await studio.project((await positionOf(studio, id))!);
      await page.mouse.move(at.x, at.y);
      await page.mouse.down();
      await page.mouse.move(at.x + x, at.y + y, { steps: 5 });
      await studio.drawn(3);
      await during?.();
      await page.mouse.up();
    };
    const lock = page.getByRole('button', { name: 'Move left and right points together' });
    await lock.click();
    expect(await lock.getAttribute('aria-pressed')).toBe('true');

    // Both move during the drag, and both are one step.
    await drag('8.3', 40, -30, async () => {
      const now = (await positionOf(studio, '8.3'))!;
      expect(apart(now, left)).toBeGreaterThan(height * 0.01);
      expect(apart((await positionOf(studio, '8.4'))!, image(now))).toBeLessThan(height * 0.01);
      await studio.keep('mirror-lock-wide');
    });
    expect(await save.innerText()).toBe('Save 2 changes');
    expect(apart((await positionOf(studio, '8.4'))!, image((await positionOf(studio, '8.3'))!))).toBeLessThan(height * 0.01);
    await page.keyboard.press('Control+z');
    expect([await positionOf(studio, '8.3'), await positionOf(studio, '8.4')]).toEqual([left, right]);
    expect(await save.innerText()).toBe('Saved');
    await page.keyboard.press('Control+Shift+z');
    expect(await save.innerText()).toBe('Save 2 changes');
    await page.keyboard.press('Control+z');

    // This pair alone is taken apart, which is remembered with the lock.
    await page.getByRole('button', { name: '8.4 moves with it' }).click();
    await drag('8.3', 40, -30);
    expect(await save.innerText()).toBe('Save 1 change');
    expect(await positionOf(studio, '8.4')).toEqual(right);
    await page.keyboard.press('Control+z');
    await page.reload();
    await openAt(studio, '8.3');
    expect(await lock.getAttribute('aria-pressed')).toBe('true');
    const link = page.getByRole('button', { name: '8.4 moves with it' });
    expect(await link.getAttribute('aria-pressed')).toBe('false');

    // By keyboard: the link, the place at the cross, removal. The camera stands in front of the point, so the head is moved.
    await link.focus();
    await page.keyboard.press('Enter');
    expect(await link.getAttribute('aria-pressed')).toBe('true');
    await page.locator('canvas.canvas').focus();
    await page.keyboard.press('Shift+ArrowRight');
    await page.keyboard.press('Space');
    expect(await save.innerText()).toBe('Save 2 changes');
    await page.keyboard.press('Delete');
    expect([await positionOf(studio, '8.3'), await positionOf(studio, '8.4')]).toEqual([null, null]);
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Control+z');
    expect([await positionOf(studio, '8.3'), await positionOf(studio, '8.4')]).toEqual([left, right]);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Lock_Finger_TakesTheOtherSideAlong', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/points?point=4.1`, { ...phone, locale: 'pt-BR' });
    const { page } = studio;
    await openAt(studio, '4.1');
    await page.getByRole('button', { name: 'Mover juntos os pontos da esquerda e da direita' }).tap();
    await page.getByRole('button', { name: '4.2 se move junto' }).waitFor();
    const before = await positionOf(studio, '4.2');
    const at = await studio.project((await positionOf(studio, '4.1'))!);
    await page.touchscreen.tap(at.x + 40, at.y - 40);
    await page.getByRole('button', { name: 'Salvar 2 mudanças' }).waitFor();
    expect(await positionOf(studio, '4.2')).not.toEqual(before);
    await studio.keep('mirror-lock-narrow');
    await page.getByRole('button', { name: 'Desfazer (Ctrl+Z)' }).tap();
    expect(await positionOf(studio, '4.2')).toEqual(before);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

import type { CDPSession } from 'playwright-core';
import { describe, expect, test } from 'vitest';
import { phone, StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });

interface Page {
  semblante: {
    scene: {
      markers: { of(id: string): { position: [number, number, number] } | null };
      stage: { camera: { position: { toArray(): number[] } } };
    };
  };
}

interface Spot {
  x: number;
  y: number;
}

const positionOf = (studio: StudioPage, id: string): Promise<[number, number, number]> =>
  studio.page.evaluate((point) => (window as unknown as Page).semblante.scene.markers.of(point)!.position, id);

/** Where a point's marker is on the page. */
const spotOf = async (studio: StudioPage, id: string): Promise<Spot> => studio.project(await positionOf(studio, id));

const camera = (studio: StudioPage): Promise<number[]> =>
  studio.page.evaluate(() => (window as unknown as Page).semblante.scene.stage.camera.position.toArray());

const apart = (a: Spot, b: Spot): number => Math.hypot(a.x - b.x, a.y - b.y);

/** The loupe on the page: its middle, its radius, the stage around it, and how much of it is drawn. */
async function loupe({ page }: StudioPage): Promise<Spot & { radius: number; inside: boolean; drawn: number }> {
  await page.locator('.loupe canvas').waitFor();
  return page.evaluate(() => {
    const element = document.querySelector<HTMLElement>('.loupe')!;
    const box = element.getBoundingClientRect();
    const stage = document.querySelector('canvas.canvas')!.getBoundingClientRect();
    const canvas = element.querySelector('canvas')!;
    const { data } = canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height);
    let opaque = 0;
    for (let i = 3; i < data.length; i += 4) opaque += data[i]! > 250 ? 1 : 0;
    const inside = box.left >= stage.left && box.right <= stage.right && box.top >= stage.top && box.bottom <= stage.bottom;
    return { x: box.left + box.width / 2, y: box.top + box.height / 2, radius: box.width / 2, inside, drawn: (opaque * 4) / data.length };
  });
}

/** The point is chosen by its address, and the camera has arrived in front of it. */
async function openAt(studio: StudioPage, id: string): Promise<void> {
  await studio.waitForStage('ready');
  await studio.page.waitForFunction((point) => (window as unknown as Page).semblante.scene.markers.of(point) !== null, id);
  await studio.page.locator('.loupe').waitFor({ state: 'attached' });
  await studio.drawn(3);
}

const unsaved = async ({ page }: StudioPage): Promise<string> => page.locator('.points .panel-foot').innerText();

describe('drag of a point', () => {
  test('Drag_Mouse_MovesThePointOverTheSkinUnderALoupe_InOneStep', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/points?point=8.1`, { width: 1440, height: 900, seen: true });
    const { page } = studio;
    await openAt(studio, '8.1');
    const eye = await camera(studio);
    const before = await positionOf(studio, '8.1');
    const from = await spotOf(studio, '8.1');
    expect(await page.locator('.loupe').isVisible()).toBe(false);
    // Taken beside its middle: it does not jump under the pointer.
    await page.mouse.move(from.x + 4, from.y - 3);
    await page.mouse.down();
    for (let i = 1; i <= 8; i += 1) await page.mouse.move(from.x + 4 + 8 * i, from.y - 3 - 10 * i);
    await studio.drawn(3);
    const seen = await loupe(studio);
    expect(seen.inside).toBe(true);
    expect(seen.drawn).toBe(1); // nothing but skin around a place on the cheek
    expect(apart(seen, { x: from.x + 68, y: from.y - 83 })).toBeGreaterThan(seen.radius + 15);
    await studio.keep('point-drag-mouse');
    await page.mouse.up();
    expect(await page.locator('.loupe').isVisible()).toBe(false);
    const to = await spotOf(studio, '8.1');
    expect(apart(to, { x: from.x + 64, y: from.y - 80 })).toBeLessThan(20); // of the nearest vertex
    expect(await camera(studio)).toEqual(eye);
    expect(await unsaved(studio)).toContain('Save 1 change');

    // Escape gives it back in the middle of a drag.
    await page.mouse.move(to.x, to.y);
    await page.mouse.down();
    await page.mouse.move(to.x - 60, to.y + 10, { steps: 4 });
    await loupe(studio);
    await page.keyboard.press('Escape');
    expect(await page.locator('.loupe').isVisible()).toBe(false);
    await page.mouse.up();
    expect(await spotOf(studio, '8.1')).toEqual(to);

    // The whole way is one step back.
    await page.keyboard.press('Control+z');
    expect(await positionOf(studio, '8.1')).toEqual(before);
    expect(await unsaved(studio)).toContain('Saved');

    // A point that is not chosen is taken by the mouse as well, and chosen by it; beside the points the head is turned.
    const other = await spotOf(studio, '9.3');
    await page.mouse.move(other.x, other.y);
    await page.mouse.down();
    await page.mouse.move(other.x + 30, other.y + 8, { steps: 4 });
    await loupe(studio);
    await page.mouse.up();
    await page.waitForFunction(() => location.hash === '#sample/points?point=9.3');
    expect(apart(await spotOf(studio, '9.3'), other)).toBeGreaterThan(10);
    expect(await camera(studio)).toEqual(eye);
    await page.mouse.move(300, 150);
    await page.mouse.down();
    await page.mouse.move(380, 170, { steps: 4 });
    await page.mouse.up();
    await studio.drawn(3);
    expect(await camera(studio)).not.toEqual(eye);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Drag_Finger_SeesThePointBesideIt_AndASecondFingerMeansTheView', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/points?point=8.1`, { ...phone, dark: true, seen: true });
    const { page } = studio;
    await openAt(studio, '8.1');
    const session = await studio.context.newCDPSession(page);
    const from = await spotOf(studio, '8.1');
    await touch(session, 'touchStart', [from]);
    for (let i = 1; i <= 8; i += 1) await touch(session, 'touchMove', [{ x: from.x - 5 * i, y: from.y - 4 * i }]);
    await studio.drawn(3);
    const finger = { x: from.x - 40, y: from.y - 32 };
    const seen = await loupe(studio);
    expect(seen.inside).toBe(true);
    expect(seen.drawn).toBeGreaterThan(0.9);
    expect(apart(seen, finger)).toBeGreaterThanOrEqual(seen.radius + 40);
    await studio.keep('point-drag-finger');
    await touch(session, 'touchEnd', []);
    expect(await page.locator('.loupe').isVisible()).toBe(false);
    const to = await spotOf(studio, '8.1');
    expect(apart(to, finger)).toBeLessThan(14);

    // At the top of the picture the loupe is at a side.
    const top = (await page.locator('canvas.canvas').boundingBox())!.y;
    await touch(session, 'touchStart', [to]);
    for (let i = 1; i <= 8; i += 1)
      await touch(session, 'touchMove', [{ x: to.x, y: to.y + ((top + 60 - to.y) * i) / 8 }]);
    await studio.drawn(3);
    const beside = await loupe(studio);
    expect(beside.inside).toBe(true);
    expect(apart(beside, { x: to.x, y: top + 60 })).toBeGreaterThanOrEqual(beside.radius + 40);
    await studio.keep('point-drag-finger-top');

    // A second finger: the point goes back, and both zoom.
    const eye = await camera(studio);
    await touch(session, 'touchStart', [{ x: to.x, y: top + 60 }, { x: to.x + 30, y: top + 160 }]);
    for (let i = 1; i <= 6; i += 1)
      await touch(session, 'touchMove', [{ x: to.x, y: top + 60 - 6 * i }, { x: to.x + 30, y: top + 160 + 12 * i }]);
    await touch(session, 'touchEnd', []);
    await studio.drawn(3);
    expect(await page.locator('.loupe').isVisible()).toBe(false);
    expect(await camera(studio)).not.toEqual(eye);
    await page.evaluate(() => (document.activeElement as HTMLElement).blur());
    expect(await unsaved(studio)).toContain('1');

    // A finger on a point that is not chosen turns the head.
    const turned = await camera(studio);
    const other = await spotOf(studio, '9.3');
    await touch(session, 'touchStart', [other]);
    for (let i = 1; i <= 6; i += 1) await touch(session, 'touchMove', [{ x: other.x + 12 * i, y: other.y }]);
    await touch(session, 'touchEnd', []);
    await studio.drawn(3);
    expect(await camera(studio)).not.toEqual(turned);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

test('Drag_Pupil_MayLieInsideATriangle_WhichTheServerKeeps', async () => {
  const studio = await StudioPage.open(browser, `${server.url}/#sample/points?point=3.5`, { width: 1440, height: 900 });
  const { page } = studio;
  await openAt(studio, '3.5');
  const from = await spotOf(studio, '3.5');
  const goal = { x: from.x + 9, y: from.y + 7 };
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(goal.x, goal.y, { steps: 5 });
  await studio.drawn(3);
  await page.mouse.up();
  expect(apart(await spotOf(studio, '3.5'), goal)).toBeLessThan(0.5); // a place of the surface, not the nearest vertex
  await page.locator('.point-card').getByText(/^At /).waitFor();
  await page.getByRole('button', { name: 'Save 1 change' }).click();
  await page.getByRole('button', { name: 'Saved' }).waitFor();
  const { points } = (await (await fetch(`${server.url}/v1/models/sample/feature-points`)).json()) as {
    points: Record<string, { vertex: number | null; position: number[] }>;
  };
  expect(points['3.5']!.vertex).toBeNull();
  const position = await positionOf(studio, '3.5');
  points['3.5']!.position.forEach((value, axis) => expect(value).toBeCloseTo(position[axis]!, 5));
  expect(studio.errors).toEqual([]);
  await studio.close();
});

async function touch(session: CDPSession, type: 'touchStart' | 'touchMove' | 'touchEnd', fingers: Spot[]): Promise<void> {
  await session.send('Input.dispatchTouchEvent', { type, touchPoints: fingers.map(({ x, y }, id) => ({ x, y, id })) });
}

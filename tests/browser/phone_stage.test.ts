import { expect, test } from 'vitest';
import { phone, StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });

type Vector = [number, number, number];
interface Camera {
  target: Vector;
  arm: Vector;
}
interface WithControls {
  semblante: { scene: { stage: { camera: { position: { toArray(): Vector } }; controls: { target: { toArray(): Vector } } } } };
}

/** What the camera looks at, and the way from there to the camera. */
const cameraOf = ({ page }: StudioPage): Promise<Camera> =>
  page.evaluate(() => {
    const { camera, controls } = (window as unknown as WithControls).semblante.scene.stage;
    const target = controls.target.toArray();
    return { target, arm: camera.position.toArray().map((x, axis) => x - target[axis]!) as Vector };
  });
const length = (a: Vector): number => Math.hypot(...a);
const angle = (a: Vector, b: Vector): number => Math.acos(Math.min(1, a.reduce((sum, x, axis) => sum + x * b[axis]!, 0) / (length(a) * length(b))));
const apart = (a: Vector, b: Vector): number => length(a.map((x, axis) => x - b[axis]!) as Vector);

test('Phone_Fingers_OneTurnsTheHeadTwoMoveItAndADoubleTapGoesNearer', async () => {
  const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { ...phone });
  const { page } = studio;
  await studio.waitForStage('ready');
  const devtools = await page.context().newCDPSession(page);
  const box = (await page.locator('canvas.canvas').boundingBox())!;
  const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  /** Drags fingers, whose places are told from the middle of the picture, to the right. */
  const drag = async (...fingers: number[]): Promise<void> => {
    const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', by: number): Promise<unknown> =>
      devtools.send('Input.dispatchTouchEvent', {
        type,
        touchPoints: type === 'touchEnd' ? [] : fingers.map((from, id) => ({ id, x: middle.x + from + by, y: middle.y })),
      });
    await touch('touchStart', 0);
    for (let by = 5; by <= 60; by += 5) {
      await touch('touchMove', by);
      await studio.drawn(1);
    }
    await touch('touchEnd', 60);
    await studio.drawn(15); // it comes to rest
  };

  const first = await cameraOf(studio);
  await drag(0);
  const turned = await cameraOf(studio);
  expect(angle(first.arm, turned.arm), 'one finger turns').toBeGreaterThan(0.1);
  expect(apart(first.target, turned.target) / length(first.arm), 'and does not move').toBeLessThan(0.001);
  await drag(-40, 40);
  const moved = await cameraOf(studio);
  expect(apart(turned.target, moved.target) / length(first.arm), 'two fingers move').toBeGreaterThan(0.02);
  expect(angle(turned.arm, moved.arm), 'and do not turn').toBeLessThan(0.01);
  for (let tap = 0; tap < 2; tap += 1) await page.touchscreen.tap(middle.x, middle.y);
  await studio.drawn(15);
  expect(length((await cameraOf(studio)).arm) / length(moved.arm), 'a double tap goes nearer').toBeLessThan(0.6);
  expect(await page.getByRole('button', { name: 'Keys' }).count(), 'fingers need no sheet of keys').toBe(0);
  expect(studio.errors).toEqual([]);
  await studio.close();
});

test('Phone_SlidersBelow_TheFaceStaysInTheUpperHalf_AndTheTitleNamesThePlace', async () => {
  const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { ...phone });
  const { page } = studio;
  await studio.waitForStage('ready');
  const stage = page.locator('canvas.canvas');
  const { height } = phone;
  const last = page.locator('.fap-group').last();
  await last.locator('summary').tap();
  const slider = last.locator('input[type=range]').last();
  await slider.scrollIntoViewIfNeeded();
  const [face, control] = [(await stage.boundingBox())!, (await slider.boundingBox())!];
  expect(face.y).toBeGreaterThanOrEqual(0);
  expect(face.y + face.height).toBeLessThanOrEqual(height * 0.6);
  expect(face.height).toBeGreaterThan(height * 0.3);
  expect(control.y).toBeGreaterThan(face.y + face.height);
  expect(control.y + control.height).toBeLessThanOrEqual(height);

  for (const [tab, title] of [
    ['animate', 'Sample head · Animate · Semblante'],
    ['points', 'Sample head · Points · Semblante'],
    ['live', 'Sample head · Live · Semblante'],
  ] as const) {
    await page.locator(`#tab-${tab}`).tap();
    await page.waitForFunction((wanted) => document.title === wanted, title);
  }
  expect(studio.errors).toEqual([]);
  await studio.close();
});

// Points between the vertices of a coarse head: placed, dragged, mirrored, undone, saved and made a vertex of the face.
import type { CDPSession } from 'playwright-core';
import { expect, test } from 'vitest';
import { eventually } from './support/patience.ts';
import { StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });

type Position = [number, number, number];

const slices = 12;
const stacks = 9;

/** An egg, symmetric in x: `stacks` rings of `slices` vertices, vertex slices * ring + slice; slice 0 faces +Z. */
const egg: Position[] = Array.from({ length: slices * stacks }, (_, v) => {
  const turn = ((v % slices) / slices) * 2 * Math.PI;
  const height = ((Math.floor(v / slices) + 0.5) / stacks) * Math.PI;
  return [0.75 * Math.sin(height) * Math.sin(turn), -Math.cos(height), 0.85 * Math.sin(height) * Math.cos(turn)];
});

function eggObj(): string {
  const lines = egg.map((place) => `v ${place.join(' ')}`);
  for (let ring = 0; ring + 1 < stacks; ring += 1)
    for (let slice = 0; slice < slices; slice += 1) {
      const [a, b] = [slices * ring + slice + 1, slices * ring + ((slice + 1) % slices) + 1];
      // The diagonals of the left half mirror those of the right.
      const [c, d] = [b + slices, a + slices];
      lines.push(...(slice < slices / 2 ? [`f ${a} ${b} ${c}`, `f ${a} ${c} ${d}`] : [`f ${a} ${b} ${d}`, `f ${b} ${c} ${d}`]));
    }
  return lines.join('\n');
}

const middle = (...vertices: number[]): Position =>
  [0, 1, 2].map((axis) => vertices.reduce((sum, v) => sum + egg[v]![axis]!, 0) / vertices.length) as Position;

/** The middle of a triangle on the left cheek, where no vertex is near. */
const [first, second, third] = [slices * 4, slices * 4 + 1, slices * 5 + 1];
const cheek = middle(first, second, third);

/** A new egg on the server, with five points at vertices; its id. */
async function newEgg(): Promise<string> {
  const made = (await (
    await fetch(`${server.url}/v1/models?name=Egg&filename=egg.obj`, { method: 'POST', headers: { 'Content-Type': 'model/obj' }, body: eggObj() })
  ).json()) as { model: { id: string } };
  const { id } = made.model;
  const imported = (): Promise<void> =>
    eventually('the egg is imported', async () => {
      const model = (await (await fetch(`${server.url}/v1/models/${id}`)).json()) as { state: string };
      return model.state !== 'importing';
    });
  await imported();
  // An egg has no front: as it stands.
  await fetch(`${server.url}/v1/models/${id}`, {
    method: 'PATCH',
    headers: { 'Content-Type': 'application/merge-patch+json' },
    body: '{"frame":{"up":"+Y","front":"+Z"}}',
  });
  await imported();
  const front = (ring: number, slice = 0): { vertex: number } => ({ vertex: slices * ring + slice });
  const points = { '9.3': front(4), '2.1': front(1), '11.4': front(7), '8.3': front(2, 1), '8.4': front(2, slices - 1) };
  const answer = await fetch(`${server.url}/v1/models/${id}/feature-points`, {
    method: 'PUT',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify({ points }),
  });
  expect(answer.status).toBe(200);
  return id;
}

const savedPoints = async (head: string): Promise<Record<string, { vertex: number | null; position: Position }>> =>
  ((await (await fetch(`${server.url}/v1/models/${head}/feature-points`)).json()) as { points: Record<string, { vertex: number | null; position: Position }> })
    .points;

const positionOf = (studio: StudioPage, id: string): Promise<Position | null> =>
  studio.page.evaluate((point) => {
    const { markers } = (window as unknown as { semblante: { scene: { markers: { of(id: string): { position: Position } | null } } } })
      .semblante.scene;
    return markers.of(point)?.position ?? null;
  }, id);

const apart = (a: Position, b: Position): number => Math.hypot(...a.map((value, axis) => value - b[axis]!));

async function openAt(studio: StudioPage): Promise<void> {
  await studio.waitForStage('ready');
  await studio.page.locator('.loupe').waitFor({ state: 'attached' });
  await studio.drawn(3);
}

test('Coarse_Mouse_PointsLieWhereTheyArePut_AndTheFaceHasAVertexThere', async () => {
  const head = await newEgg();
  const studio = await StudioPage.open(browser, `${server.url}/#${head}/points?point=5.3`, { width: 1440, height: 900 });
  const { page } = studio;
  await openAt(studio);
  const card = page.locator('.point-card');
  const at = await studio.project(cheek);
  await page.mouse.click(at.x, at.y);
  await card.getByText(/^At /).waitFor();
  expect(apart((await positionOf(studio, '5.3'))!, cheek)).toBeLessThan(0.01);

  // Under the loupe to another place between vertices, in one step.
  await page.locator('#tab-points').focus();
  const from = await studio.project((await positionOf(studio, '5.3'))!);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 12, from.y + 9, { steps: 5 });
  await studio.drawn(3);
  await studio.keep('between-drag-wide');
  await page.mouse.up();
  const to = await studio.project((await positionOf(studio, '5.3'))!);
  expect(Math.hypot(to.x - from.x - 12, to.y - from.y - 9)).toBeLessThan(1);
  await page.keyboard.press('Control+z');
  expect(apart((await positionOf(studio, '5.3'))!, cheek)).toBeLessThan(0.01);

  // Beside a vertex the vertex is meant, beside an edge the edge.
  const corner = await studio.project(egg[second]!);
  await page.mouse.click(corner.x + 3, corner.y + 2);
  await card.getByText(`On vertex ${second}.`).waitFor();
  const edge = middle(first, second);
  const onEdge = await studio.project(edge);
  await page.mouse.click(onEdge.x, onEdge.y + 1);
  await card.getByText(/^At /).waitFor();
  expect(apart((await positionOf(studio, '5.3'))!, edge)).toBeLessThan(0.01);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');

  // The other side lies between vertices too.
  await page.getByRole('button', { name: 'Move left and right points together' }).click();
  await page.mouse.click(at.x, at.y + 4);
  await page.getByRole('button', { name: 'Save 2 changes' }).waitFor();
  const [x, y, z] = (await positionOf(studio, '5.3'))!;
  expect(apart((await positionOf(studio, '5.4'))!, [-x, y, z])).toBeLessThan(1e-4);
  await page.getByRole('button', { name: 'Save 2 changes' }).click();
  await page.getByRole('button', { name: 'Saved' }).waitFor();
  const saved = await savedPoints(head);
  for (const id of ['5.3', '5.4']) {
    expect(saved[id]!.vertex, id).toBeNull();
    expect(apart(saved[id]!.position, (await positionOf(studio, id))!), id).toBeLessThan(1e-6);
  }

  const panel = page.locator('.points .panel-foot');
  await panel.getByRole('button', { name: 'Make it move (parametrize)' }).click();
  await studio.waitForState('parametrized');
  await page.locator('#tab-animate').click();
  await page.waitForFunction(() => (window as unknown as Inside).semblante.scene.rig !== null);
  const face = await page.evaluate(() => {
    const { scene } = (window as unknown as Inside).semblante;
    const own = scene.rig!.feature_points.filter(({ id }) => id === '5.3' || id === '5.4');
    const { rowOffsets, rowWeights, vertexCount } = scene.face!.mesh;
    return { vertexCount, weights: own.map(({ vertex }) => Array.from(rowWeights.slice(rowOffsets[vertex!], rowOffsets[vertex! + 1]))) };
  });
  expect(face.vertexCount).toBe(egg.length + 2);
  for (const row of face.weights) expect(row).toEqual([1]);
  expect(studio.errors).toEqual([]);
  await studio.close();
});

async function touch(session: CDPSession, type: 'touchStart' | 'touchMove' | 'touchEnd', fingers: { x: number; y: number }[]): Promise<void> {
  await session.send('Input.dispatchTouchEvent', { type, touchPoints: fingers.map(({ x, y }, id) => ({ x, y, id })) });
}

test('Coarse_FingerAndKeyboard_PointsLieBetweenVertices', async () => {
  const head = await newEgg();
  const context = await browser.newContext({
    viewport: { width: 390, height: 844 },
    hasTouch: true,
    isMobile: true,
    reducedMotion: 'reduce',
    colorScheme: 'dark',
    locale: 'pt-BR',
  });
  const studio = await StudioPage.openIn(context, `${server.url}/#${head}/points?point=5.3`);
  const { page } = studio;
  await openAt(studio);
  const card = page.locator('.point-card');
  const at = await studio.project(cheek);
  await page.touchscreen.tap(at.x, at.y);
  await card.getByText(/^Em /).waitFor();
  const tapped = (await positionOf(studio, '5.3'))!;
  expect(apart(tapped, cheek)).toBeLessThan(0.03);

  const session = await context.newCDPSession(page);
  const from = await studio.project(tapped);
  await touch(session, 'touchStart', [from]);
  for (let i = 1; i <= 6; i += 1) await touch(session, 'touchMove', [{ x: from.x + 2.5 * i, y: from.y - i }]);
  await studio.drawn(3);
  await studio.keep('between-drag-narrow-dark');
  await touch(session, 'touchEnd', []);
  const to = await studio.project((await positionOf(studio, '5.3'))!);
  expect(Math.hypot(to.x - from.x - 15, to.y - from.y + 6)).toBeLessThan(2);

  // The cross in the middle of the picture, by keyboard.
  await page.locator('canvas.canvas').focus();
  await page.keyboard.press('Shift+ArrowRight');
  await page.keyboard.press('Space');
  const byKeys = (await positionOf(studio, '5.3'))!;
  expect(apart(byKeys, cheek)).toBeGreaterThan(0.02);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  expect(await positionOf(studio, '5.3')).toEqual(tapped);
  await page.getByRole('button', { name: 'Salvar 1 mudança' }).tap();
  await page.getByRole('button', { name: 'Salvo' }).waitFor();
  expect((await savedPoints(head))['5.3']!.vertex).toBeNull();
  expect(studio.errors).toEqual([]);
  await studio.close();
});

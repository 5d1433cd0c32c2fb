import { mkdirSync, mkdtempSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { faces, sampleHead, samplePoints } from './support/paths.ts';
import { eventually } from './support/patience.ts';
import { startServer } from './support/server.ts';
import { StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

/** The region of mouth and chin in the front view, above the tools. */
const mouth = [0.33, 0.62, 0.34, 0.29] as const;
/** A region of the face without the tools that float above and below the head. */
const faceAlone = [0.3, 0.2, 0.4, 0.5] as const;

interface PointsFile {
  points: Record<string, { vertex: number; position: [number, number, number] }>;
}

const scratch = mkdtempSync(join(tmpdir(), 'semblante-studio-'));

useStudio({ demo: false });

async function importPoints(studio: StudioPage, path: string): Promise<void> {
  await studio.page.setInputFiles('#points-file', path);
}

/** Writes a GLB as chosen.gltf with its buffer in chosen.bin. */
function writeGltf(folder: string, glb: Buffer): string[] {
  const jsonLength = glb.readUInt32LE(12);
  const document = JSON.parse(glb.subarray(20, 20 + jsonLength).toString()) as { buffers: { uri?: string }[] };
  document.buffers[0]!.uri = 'chosen.bin';
  mkdirSync(folder, { recursive: true });
  const files = [join(folder, 'chosen.gltf'), join(folder, 'chosen.bin')];
  writeFileSync(files[0]!, JSON.stringify(document));
  writeFileSync(files[1]!, glb.subarray(20 + jsonLength + 8));
  return files;
}

/** Drops a head and its points, places one point by a click, parametrizes; ends on the Animate tab. */
async function bringToLife(studio: StudioPage, head: string, points: string): Promise<void> {
  const { page } = studio;
  await studio.drop(head);
  await studio.waitForState('ready');
  await studio.waitForStage('ready');
  await page.locator('#tab-points').click();
  await importPoints(studio, points);
  await page
    .getByText(/\d+ of 84 placed/)
    .filter({ hasNotText: /^0 of/ })
    .waitFor();

  // The tip of the nose is removed and placed again with the pointer.
  const file = JSON.parse(readFileSync(points, 'utf8')) as PointsFile;
  const nose = file.points['9.3']!;
  await page.getByRole('searchbox', { name: 'Search feature points' }).fill('9.3');
  await page.locator('[data-point="9.3"]').click();
  await page.getByRole('button', { name: 'Remove point 9.3' }).click();
  await page.getByText('Click on the head to place it.').waitFor();
  const spot = await studio.project(nose.position);
  await page.mouse.click(spot.x, spot.y);
  await page.getByText(/^On vertex \d+/).waitFor();
  const placed = Number(/\d+/.exec(await page.getByText(/^On vertex \d+/).innerText())![0]);
  expect(placed).toBeGreaterThanOrEqual(0);
  await page.getByRole('searchbox', { name: 'Search feature points' }).fill('');

  await page.getByRole('button', { name: 'Make it move (parametrize)' }).click();
  await studio.waitForState('parametrized');
  await studio.waitForStage('ready');
  await page.locator('#tab-animate[aria-selected="true"]').waitFor();
}

async function moveSliderAndCompare(studio: StudioPage): Promise<void> {
  const { page } = studio;
  const before = await studio.pictureAtRest();
  await page.locator('details[data-group="2"] summary').click();
  const jaw = page.getByRole('slider', { name: 'Open jaw' });
  await jaw.fill('600');
  const after = await studio.pictureAtRest();
  // Mean difference per channel, 0..255; small, because the jaw moves only a part of this region.
  const moved = await studio.difference(before, after, mouth);
  expect(moved).toBeGreaterThan(0.8);
  // The jaw does not move the forehead.
  expect(await studio.difference(before, after, [0.4, 0.18, 0.2, 0.1])).toBeLessThan(moved / 5);

  await page.getByRole('button', { name: 'Neutral face' }).click();
  expect(await studio.difference(before, await studio.pictureAtRest(), faceAlone)).toBeLessThan(0.2);
}

describe('studio', () => {
  test('Studio_FirstVisit_SampleHeadMovesByTheDemoStream', async () => {
    const withDemo = await startServer();
    try {
      const studio = await StudioPage.open(browser, withDemo.url);
      await studio.waitForStage('ready');
      await studio.page
        .getByText(/^Live: /)
        .first()
        .waitFor();
      await studio.pictureUnlike(await studio.picture(), faceAlone, 0.5);
      expect(studio.errors).toEqual([]);
      await studio.close();
    } finally {
      await withDemo.stop();
    }
  });

  test('Studio_GraphicsContextLost_IsDrawnAgain', async () => {
    const studio = await StudioPage.open(browser, server.url, { allowed: /Context Lost/, seen: true });
    await studio.waitForStage('ready');
    const before = await studio.pictureAtRest();
    const context = await studio.page.evaluateHandle(() => {
      const canvas = document.querySelector<HTMLCanvasElement>('canvas.canvas')!;
      return canvas.getContext('webgl2')!.getExtension('WEBGL_lose_context')!;
    });
    await context.evaluate((extension) => extension.loseContext());
    await studio.pictureUnlike(before, faceAlone, 5);
    await context.evaluate((extension) => extension.restoreContext());
    await eventually('the same picture, with the same light', async () => {
      return (await studio.difference(before, await studio.picture(), faceAlone)) < 0.5;
    });
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Studio_DropMarkParametrize_SliderMovesTheMouth', async () => {
    const studio = await StudioPage.open(browser, server.url);
    await studio.waitForStage('ready');
    await bringToLife(studio, sampleHead, samplePoints);
    await moveSliderAndCompare(studio);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test.skipIf(faces === null)('Studio_DropMakeHuman_SliderMovesTheMouth', async () => {
    const studio = await StudioPage.open(browser, server.url);
    await studio.waitForStage('ready');
    await bringToLife(studio, join(faces!, 'makehuman/head.glb'), join(faces!, 'makehuman/makehuman.fps.json'));
    await moveSliderAndCompare(studio);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Studio_RefusedPoints_ReasonStandsBesideThePoint', async () => {
    const studio = await StudioPage.open(browser, server.url, { allowed: /status of 4\d\d/ });
    await studio.waitForStage('ready');
    await studio.drop(sampleHead, 'refused.glb');
    await studio.waitForState('ready');
    await studio.waitForStage('ready');
    const bad = join(scratch, 'bad.fps.json');
    writeFileSync(bad, JSON.stringify({ points: { '2.1': { vertex: 99_999_999 } } }));
    await importPoints(studio, bad);
    await studio.page.locator('.point-card .reason').filter({ hasText: '/points/2.1' }).waitFor();
    expect(await studio.page.locator('[data-point="2.1"]').getAttribute('class')).toContain('wrong');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Studio_FileThatIsNoModel_SaysSo', async () => {
    const studio = await StudioPage.open(browser, server.url, { allowed: /status of 4\d\d/ });
    await studio.waitForStage('ready');
    const text = join(scratch, 'letter.glb');
    writeFileSync(text, 'Dear reader, this is not a head.');
    await studio.drop(text);
    await studio.page.locator('.toast-error, .stage-card.error').first().waitFor();
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Studio_UploadThatLosesItsConnection_IsTriedAgainByAPress', async () => {
    const studio = await StudioPage.open(browser, server.url, { allowed: /ERR_FAILED|Failed to load/ });
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.route('**/v1/models?filename=*', (route) => route.abort());
    await studio.drop(sampleHead, 'lost.glb');
    const again = page.locator('.toast-error', { hasText: 'lost.glb was not accepted' }).getByRole('button', { name: 'Try again' });
    await again.waitFor();
    await page.unroute('**/v1/models?filename=*');
    // The message stays when the server answers again, since the head was not uploaded.
    await page.evaluate(() => (window as unknown as { semblante: { studio: { toasts: { serverIsBack(): void } } } }).semblante.studio.toasts.serverIsBack());
    await again.click();
    await studio.waitForState('ready');
    expect(await page.locator('.toast-error').count()).toBe(0);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Studio_HeadThatCannotBeRead_OffersAnotherAndGoes', async () => {
    const studio = await StudioPage.open(browser, server.url, { width: 1280, height: 720, allowed: /status of 4\d\d/ });
    const { page } = studio;
    await studio.waitForStage('ready');
    await studio.dropText('letter.txt', 'Dear reader, this is not a head.');
    const message = page.locator('.toast-error p').first();
    await message.waitFor();
    expect(await message.innerText()).toBe('The file is none of GLB, VRM, glTF, OBJ, PLY, STL, ZIP');
    await studio.dropText('broken.obj', 'v 0 0 zebra\n');
    const card = page.locator('.stage-card.error');
    await card.getByRole('button', { name: 'Upload a head' }).waitFor();
    await page.locator('#tab-points').click();
    await page.locator('#panel-points').getByText('This head could not be read').waitFor();
    expect(await page.getByRole('button', { name: 'Start' }).count(), 'there is nothing to place points on').toBe(0);
    // Opened from the still model of another head too.
    await page.locator('[data-model=sample] .open').click();
    await page.locator('#tab-points').click();
    await studio.waitForStage('ready');
    await page.locator('.head', { hasText: 'broken' }).locator('.open').click();
    await card.getByText('The model file cannot be read').waitFor();
    await studio.drawn(10);
    expect(await card.innerText()).toContain("'zebra' in place of a number");
    await card.getByRole('button', { name: 'Take it off the list' }).click();
    await page.locator('.head', { hasText: 'broken' }).waitFor({ state: 'detached' });
    await studio.waitForStage('ready');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Studio_DroppedFile_OnADialogIsNotOpenedByTheBrowser_ElseIsShownWhereItIsTaken', async () => {
    const studio = await StudioPage.open(browser, server.url);
    const { page, context } = studio;
    await studio.waitForStage('ready');
    await page.locator('#tab-animate').press('?');
    await page.locator('dialog[open]').waitFor();
    const text = join(scratch, 'letter.txt');
    writeFileSync(text, 'Dear reader');
    const devtools = await context.newCDPSession(page);
    const data = { items: [], files: [text], dragOperationsMask: 1 };
    const [x, y] = [440, 280];
    for (const type of ['dragEnter', 'dragOver', 'drop'] as const) await devtools.send('Input.dispatchDragEvent', { type, x, y, data });
    await studio.drawn(5); // the browser opens it in another tab, or here
    expect([context.pages().length, page.url().startsWith(server.url)]).toEqual([1, true]);

    // What the page takes is shown where it is taken.
    await page.keyboard.press('Escape');
    await page.locator('#tab-fit').click();
    await studio.dropText('take.json', '{"hello": 1}');
    await page.locator('.performance').getByText('take.json').waitFor();
    await page.waitForFunction(() => {
      const { top } = document.querySelector('.performance')!.getBoundingClientRect();
      return top >= 0 && top < innerHeight - 40;
    });
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Studio_ManyHeads_NewestFirstAndFoundByName', async () => {
    const studio = await StudioPage.open(browser, server.url, { width: 1280, height: 720 });
    const { page } = studio;
    await studio.waitForStage('ready');
    const [sample] = ((await (await fetch(`${server.url}/v1/models`)).json()) as { models: object[] }).models;
    const many = Array.from({ length: 30 }, (_, i) => ({ ...sample, id: `head${i}`, name: `Head number ${i}`, created: new Date(Date.UTC(2040, 0, 1 + i)).toISOString() }));
    await page.route(/\/v1\/models\?limit/, (route) => route.fulfill({ json: { models: [sample, ...many], next: null } }));
    await page.reload();
    await studio.waitForStage('ready');
    await page.locator('.head').nth(30).waitFor({ state: 'attached' });
    expect(await page.locator('.head strong').first().innerText()).toBe('Head number 29');
    const list = await page.locator('.heads').boundingBox();
    expect(list!.height, 'the list has most of the height').toBeGreaterThan(360);
    // Progress is drawn many times a second: items that show the same stay the same.
    const stays = await page.evaluate(() => {
      const [first] = document.querySelectorAll('.head');
      (window as unknown as { semblante: { studio: { activities: { notify(): void } } } }).semblante.studio.activities.notify();
      return document.querySelector('.head') === first;
    });
    expect(stays).toBe(true);
    await page.getByRole('searchbox', { name: 'Search heads' }).fill('29 number');
    await page.locator('.head').nth(1).waitFor({ state: 'detached' });
    expect(await page.locator('.head strong').allInnerTexts()).toEqual(['Head number 29']);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Studio_VrmFile_IsOfferedAndRead_AlsoIfItsNameIsTooLongForAHead', async () => {
    const studio = await StudioPage.open(browser, server.url);
    const { page } = studio;
    await studio.waitForStage('ready');
    expect((await page.locator('#file').getAttribute('accept'))?.split(',')).toContain('.vrm');
    const upload = page.waitForRequest((request) => request.method() === 'POST' && request.url().includes('/v1/models?'));
    await studio.drop(sampleHead, `\u200F${'ראש'.repeat(40)}.vrm`); // 240 bytes, and a mark of direction as in right-to-left names
    expect((await upload).headers()['content-type']).toBe('model/gltf-binary');
    await studio.waitForState('ready');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Studio_AGltfWithItsFiles_ChosenOrDroppedAsAFolder_BecomesOneHead', async () => {
    const studio = await StudioPage.open(browser, server.url);
    await studio.waitForStage('ready');
    const folder = join(scratch, 'Ana');
    const files = writeGltf(folder, readFileSync(sampleHead));
    writeFileSync(join(folder, 'LICENSE.txt'), 'Everyone may use this head.');
    await studio.page.setInputFiles('#file', files);
    await studio.waitForState('ready');
    await studio.page.locator('#tab-heads').click();
    await studio.page.locator('.head', { hasText: 'chosen' }).waitFor();

    for (const file of files) renameSync(file, file.replace('chosen', 'dropped'));
    writeFileSync(join(folder, 'dropped.gltf'), readFileSync(join(folder, 'dropped.gltf'), 'utf8').replace('chosen.bin', 'dropped.bin'));
    await studio.dropReal(folder);
    await studio.page.locator('.head', { hasText: 'dropped' }).waitFor();
    await studio.waitForState('ready');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Studio_RenameAndDelete_ShelfFollows', async () => {
    const studio = await StudioPage.open(browser, server.url);
    const { page } = studio;
    await studio.waitForStage('ready');
    await studio.drop(sampleHead, 'short-lived.glb');
    await studio.waitForState('ready');
    await page.locator('#tab-heads').click();
    const entry = page.locator('.head', { hasText: 'short-lived' });
    await entry.hover();
    await entry.getByRole('button', { name: 'Rename short-lived' }).click();
    const name = page.getByRole('textbox', { name: 'Name' });
    await name.fill('שם'.repeat(51)); // 204 bytes: the dialog stays with what was typed
    await page.getByRole('button', { name: 'Rename', exact: true }).last().click();
    expect(await name.evaluate((input) => (input as HTMLInputElement).validationMessage)).toBe('The name is too long.');
    await name.fill('Renamed head');
    await page.getByRole('button', { name: 'Rename', exact: true }).last().click();
    const renamed = page.locator('.head', { hasText: 'Renamed head' });
    await renamed.waitFor();
    await renamed.hover();
    await renamed.getByRole('button', { name: 'Delete Renamed head' }).click();
    await page.getByRole('dialog').getByRole('button', { name: 'Delete' }).click();
    await renamed.waitFor({ state: 'detached' });
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Studio_PublishByHand_AnotherPageSeesIt', async () => {
    const director = await StudioPage.open(browser, server.url);
    await director.waitForStage('ready');
    await director.page.locator('#tab-live').click();
    await director.page.getByRole('button', { name: 'New stream' }).click();
    await director.page.getByRole('textbox', { name: 'Title' }).fill('Two pages');
    await director.page.getByRole('button', { name: 'Create' }).click();
    await director.page.locator('.stream', { hasText: 'Two pages' }).waitFor();
    await director.page.getByLabel('Stream to send to').selectOption({ label: 'Two pages' });
    await director.page.getByRole('switch', { name: 'Publish my sliders' }).check();
    await director.page.getByText('Publishing: move a slider in Animate.').waitFor();

    const viewer = await StudioPage.open(browser, server.url);
    await viewer.waitForStage('ready');
    await viewer.page.locator('#tab-live').click();
    await viewer.page.locator('.stream', { hasText: 'Two pages' }).getByRole('button', { name: 'Watch' }).click();
    await viewer.page.getByText('Live: Two pages').first().waitFor();
    const before = await viewer.pictureAtRest();
    await director.page.locator('#tab-animate').click();
    await director.page.locator('[data-viseme="10"]').click();
    await viewer.pictureUnlike(before, mouth, 1);
    expect([...director.errors, ...viewer.errors]).toEqual([]);
    await Promise.all([director.close(), viewer.close()]);
  });

  test('Studio_StreamsWhoseFramesGoOn_StayTheSameItemsAndOptions', async () => {
    const post = (path: string, body: object): Promise<Response> =>
      fetch(`${server.url}/v1/streams${path}`, { method: 'POST', headers: { 'content-type': 'application/json' }, body: JSON.stringify(body) });
    await post('', { name: 'fed' });
    await post('', { name: 'quiet' });
    const studio = await StudioPage.open(browser, `${server.url}/#sample/live`);
    const { page } = studio;
    const fed = page.locator('[data-stream="fed"]');
    await fed.waitFor();
    const parts = await page.evaluateHandle(() => [...document.querySelectorAll('[data-stream], option[value="fed"]')]);
    expect(await parts.evaluate((elements) => elements.length)).toBeGreaterThanOrEqual(5); // two items, and a choice in four lists
    const count = (): Promise<number | undefined> => page.evaluate(() => (window as unknown as Inside).semblante.live.streams.value?.find(({ id }) => id === 'fed')?.sequence);
    const before = (await count())!;
    await post('/fed/frames', { frames: [{ faps: { 3: 100 } }] });
    await eventually('the page knows of another frame', async () => (await count())! > before);
    expect(await parts.evaluate((elements) => elements.filter((element) => !element.isConnected).length)).toBe(0);
    // What an item shows is drawn anew, the others stay.
    const quiet = await page.locator('[data-stream="quiet"]').elementHandle();
    await fed.getByRole('button', { name: 'Watch' }).click();
    await fed.getByText('1 subscriber').waitFor();
    expect(await quiet!.evaluate((element) => element.isConnected)).toBe(true);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

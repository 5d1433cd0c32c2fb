import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, test } from 'vitest';
import { root } from './support/paths.ts';
import { eventually } from './support/patience.ts';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

const scratch = mkdtempSync(join(tmpdir(), 'semblante-performance-'));
const faceAlone = [0.3, 0.1, 0.4, 0.8] as const;
const hello = readFileSync(join(root, 'protocol/examples/performances/hello.json'), 'utf8');

useStudio({ demo: false });
afterAll(async () => {
  rmSync(scratch, { recursive: true, force: true });
});

const file = (name: string, text: string): string => {
  const path = join(scratch, name);
  writeFileSync(path, text);
  return path;
};

describe('performance', () => {
  test('Performance_Dropped_PlaysOnTheFaceAndStops', async () => {
    const studio = await StudioPage.open(browser, server.url);
    const { page } = studio;
    await studio.waitForStage('ready');
    // A long cue, so that its effect is visible whenever the test compares pictures.
    const cues = [{ time: 0, duration: 590_000, expression: 'joy', value: 1 }];
    const smile = { format: 'semblante.performance', version: 1, name: 'A long smile', duration: 600_000, cues };
    const neutral = await studio.pictureAtRest();
    await page.locator('#tab-live').click();
    await studio.drop(file('smile.json', JSON.stringify(smile)));
    await page.locator('.performance').getByText('smile.json').waitFor();
    await page.locator('.performance').getByRole('button', { name: 'Play', exact: true }).click();
    await page.locator('.performance .transport').getByText('A long smile').waitFor();
    await page.locator('.performance').getByText('/ 10:00.0').waitFor();
    await page.getByText(/^Live: .*performing/).first().waitFor();
    await studio.pictureUnlike(neutral, faceAlone, 0.5);
    const smiling = await studio.pictureAtRest();
    await page.locator('.performance').scrollIntoViewIfNeeded();
    await studio.keep('performance-playing');

    await page.locator('.performance').getByRole('button', { name: 'Stop' }).click();
    await page.locator('.performance').getByRole('button', { name: 'Stop' }).waitFor({ state: 'detached' });
    await studio.pictureUnlike(smiling, faceAlone, 0.5);
    // The stream was made for this page, and ends with it.
    const performing = async (): Promise<number> => {
      const { streams } = (await (await fetch(`${server.url}/v1/streams`)).json()) as { streams: { title: string }[] };
      return streams.filter(({ title }) => title.endsWith('performing')).length;
    };
    expect(await performing()).toBe(1);
    expect(studio.errors).toEqual([]);
    await page.goto('about:blank');
    await eventually('its stream has ended', async () => (await performing()) === 0);
    await studio.close();
  });

  test('Performance_WithAFault_ShowsTheLine', async () => {
    const studio = await StudioPage.open(browser, server.url, { allowed: /status of 4\d\d/ });
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.locator('#tab-live').click();
    await studio.drop(file('wrong.json', hello.replace('"viseme": "n_l"', '"viseme": "xyz"')));
    await page.locator('.performance').getByRole('button', { name: 'Play', exact: true }).click();
    await page.locator('.performance .excerpt .marked').filter({ hasText: '"xyz"' }).waitFor();
    await page.locator('.performance').getByText('/cues/3/viseme').waitFor();
    await page.locator('.performance .excerpt').scrollIntoViewIfNeeded();
    await studio.keep('performance-wrong');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Performance_BusyStream_CanBeTakenOver', async () => {
    const made = await fetch(`${server.url}/v1/streams`, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify({ name: 'busy', title: 'Busy' }),
    });
    expect(made.status).toBe(201);
    const started = await fetch(`${server.url}/v1/streams/busy/performances?loop=true`, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: hello.replace('"name": "Hello"', '"name": "Aria"'),
    });
    expect(started.status).toBe(202);

    const studio = await StudioPage.open(browser, server.url, { allowed: /status of 409/ });
    const { page } = studio;
    const section = page.locator('.performance');
    await studio.waitForStage('ready');
    await page.locator('#tab-live').click();
    await section.getByLabel('Stream to play into').selectOption({ label: 'Busy' });
    await section.locator('.transport').getByText('Aria').waitFor();
    await section.getByLabel('Example').selectOption({ index: 2 });
    await section.getByRole('button', { name: 'Play', exact: true }).click();
    await section.getByRole('alert').filter({ hasText: 'Aria' }).waitFor();
    await section.getByRole('alert').scrollIntoViewIfNeeded();
    await studio.keep('performance-busy');
    await section.getByRole('button', { name: 'Take over' }).click();
    await section.locator('.transport').getByText('A minute').waitFor();

    // The slider restarts the performance at another position.
    await section.getByRole('slider', { name: 'Position' }).fill('30000');
    await section.getByText(/^0:[345]\d\.\d \/ 1:00\.0$/).waitFor();
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('FapFile_Dropped_PlaysOnThisFaceAlone', async () => {
    const studio = await StudioPage.open(browser, server.url);
    const { page } = studio;
    await studio.waitForStage('ready');
    const clip = page.locator('.clip');
    // Jaw, pupils and tongue from zero to large values in a minute, with a mask of 69 flags.
    const mask = Array.from({ length: 69 }, (_, i) => ([3, 29, 30, 47].includes(i + 1) ? 1 : 0)).join(' ');
    const frames = Array.from({ length: 60 }, (_, i) => `${mask}\n${i} ${i * 12} ${i * 5} ${i * 5} ${i * 1500}`);
    await studio.drop(file('wide.fap', `2.1 wide 1 60\n${frames.join('\n')}\n`));
    await clip.getByText('wide.fap').waitFor();
    await clip.getByText('1 deviation from the usual form').waitFor();
    await clip.getByRole('button', { name: 'Pause' }).click();
    await clip.getByRole('slider', { name: 'Position' }).fill('0');
    const before = await studio.pictureAtRest();
    await clip.getByRole('slider', { name: 'Position' }).fill('58000');
    await clip.getByText('0:58.0 / 0:59.0').waitFor();
    await studio.pictureUnlike(before, faceAlone, 0.5);
    await clip.scrollIntoViewIfNeeded();
    await studio.keep('clip-paused');

    await studio.drop(file('torn.fap', `2.1 torn 25 1\n${mask}\n0 1 x 3 4\n`));
    await clip.locator('.excerpt .marked').filter({ hasText: '0 1 x 3 4' }).waitFor();
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Performance_DroppedOnAnimate_PlaysOnThisFaceAlone', async () => {
    const studio = await StudioPage.open(browser, server.url);
    const { page } = studio;
    await studio.waitForStage('ready');
    const clip = page.locator('.clip');
    const chip = page.locator('.driver');
    const posted: string[] = [];
    page.on('request', (request) => {
      if (request.method() !== 'GET') posted.push(request.url());
    });
    const cues = [{ time: 0, fap: 'open_jaw', keys: [[0, 0], [50_000, 1000]] }];
    const yawn = { format: 'semblante.performance', version: 1, duration: 60_000, cues };
    await studio.drop(file('yawn.json', JSON.stringify(yawn)));
    await chip.getByText('Playing yawn.json').waitFor();
    await clip.getByText('1 cue', { exact: true }).waitFor();
    await clip.getByRole('button', { name: 'Pause' }).click();
    await chip.getByText('yawn.json, paused').waitFor();
    await clip.getByRole('slider', { name: 'Position' }).fill('0');
    const before = await studio.pictureAtRest();
    await clip.getByRole('slider', { name: 'Position' }).fill('49000');
    await clip.getByText('0:49.0 / 1:00.0').waitFor();
    await studio.pictureUnlike(before, faceAlone, 0.5);
    await clip.scrollIntoViewIfNeeded();
    await studio.keep('clip-performance-paused');

    // Controlled by the sliders again, with idle life: the face moves although no slider moves.
    await page.getByRole('switch', { name: 'Idle life' }).check();
    await chip.getByText('By hand').waitFor();
    // After the easing from the clip's pose to the neutral face, the only motion left is idle life.
    await studio.drawn(10);
    await studio.pictureUnlike(await studio.picture(), faceAlone, 0.02);
    await page.getByRole('switch', { name: 'Idle life' }).uncheck();
    const still = await studio.pictureAtRest();
    await studio.drawn(10);
    expect(await studio.difference(still, await studio.picture(), faceAlone)).toBe(0);

    await studio.drop(file('wrong.json', hello.replace('"viseme": "n_l"', '"viseme": "xyz"')));
    await clip.locator('.excerpt .marked').filter({ hasText: '"xyz"' }).waitFor();
    await clip.getByText('/cues/3/viseme').waitFor();
    expect(posted).toEqual([]);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { loadMotion, readTake } from '@client/motion/index.ts';
import { buildDir } from './support/paths.ts';
import { eventually, patience } from './support/patience.ts';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

const faceAlone = [0.3, 0.1, 0.4, 0.8] as const;

useStudio();

const post = async (path: string, json: unknown): Promise<Response> =>
  fetch(`${server.url}/v1/streams${path}`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify(json),
  });

describe('recordings', () => {
  test('Demo_Recorded_PlaysIntoAnotherStreamAndDownloads', async () => {
    expect((await post('', { name: 'other', title: 'Other', batch_interval: 0, viseme_share: 0.5 })).status).toBe(201);
    const studio = await StudioPage.open(browser, server.url, { allowed: /status of 409/ });
    const { page } = studio;
    const section = page.locator('.recordings');
    await studio.waitForStage('ready');
    await page.locator('#tab-live').click();
    await page.getByLabel('About the stream').getByText('The server’s demo').waitFor();

    await section.getByRole('button', { name: 'Record', exact: true }).click();
    const stop = section.getByRole('button', { name: 'Stop recording Demo' });
    await stop.waitFor();
    await section.getByText(/since .* · [1-9]\d* s · [1-9]\d* frames/).waitFor();
    type Recordings = { recordings: { state: string; frames: number; duration: number; name: string }[] };
    const recorded = async (): Promise<Recordings['recordings']> =>
      ((await (await fetch(`${server.url}/v1/streams/demo/recordings`)).json()) as Recordings).recordings;
    await eventually('something is recorded', async () => (await recorded())[0]!.duration > 1500);
    await section.scrollIntoViewIfNeeded();
    await studio.keep('recording');
    await stop.click();
    const item = section.locator('.recording');
    await item.getByText(/0:\d\d\.\d · \d+ frames · /).waitFor();
    const recordings = await recorded();
    expect(recordings).toHaveLength(1);
    expect(recordings[0]!.state).toBe('finished');
    expect(recordings[0]!.duration).toBeGreaterThan(1500);

    // The .fap file can be parsed and contains the recorded frames.
    await item.getByRole('button', { name: /^More of/ }).click();
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      item.getByRole('button', { name: '.fap', exact: true }).click(),
    ]);
    expect(download.suggestedFilename()).toBe(`${recordings[0]!.name}.fap`);
    const library = await loadMotion(() => readFileSync(join(buildDir, 'wasm/semblante_motion.wasm')));
    const take = readTake(library, 'fap', readFileSync(await download.path()));
    expect(take.frames.length).toBeGreaterThan(0);
    const [clip] = await Promise.all([
      page.waitForEvent('download'),
      item.getByRole('button', { name: 'GLB clip' }).click(),
    ]);
    expect(readFileSync(await clip.path()).subarray(0, 4).toString()).toBe('glTF');

    // Play into another stream; the page asks for confirmation when it has a source.
    await section.getByLabel('Stream to play recordings into').selectOption({ label: 'Other' });
    await item.getByRole('button', { name: /^Play / }).click();
    await page.getByText('Live: Other').first().waitFor();
    await page.getByLabel('About the stream').getByText('50 %').waitFor();
    await page.getByLabel('About the stream').getByText('None').waitFor();
    await expect
      .poll(async () => ((await (await fetch(`${server.url}/v1/streams/other`)).json()) as { sequence: number }).sequence, {
        timeout: patience,
      })
      .toBeGreaterThan(20);
    // The list now shows the recordings of the subscribed stream.
    await section.getByText('Nothing recorded yet.').waitFor();

    const smile = [{ time: 0, duration: 590_000, expression: 'joy', value: 1 }];
    const performance = { format: 'semblante.performance', version: 1, name: 'Smile', duration: 600_000, cues: smile };
    expect((await post('/other/performances?take_over=true', performance)).status).toBe(202);
    await section.getByLabel('Stream to record').selectOption({ label: 'Demo' });
    await section.getByRole('button', { name: 'Play Demo' }).click();
    await page.getByRole('dialog', { name: 'Take Other over?' }).waitFor();
    await studio.keep('recording-take-over');
    await page.getByRole('button', { name: 'Take over' }).click();
    await expect
      .poll(
        async () =>
          ((await (await fetch(`${server.url}/v1/streams/other`)).json()) as { playing: { name: string } | null }).playing
            ?.name ?? null,
        { timeout: patience },
      )
      .not.toBe('Smile');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Recording_SoughtOnThePage_ShowsThatFaceAloneAndIsDeleted', async () => {
    // The recorded face opens its mouth after 1.5 s.
    expect((await post('', { name: 'takes', title: 'Takes' })).status).toBe(201);
    const started = await post('/takes/recordings', { name: 'A yawn, with a name that is rather long for one line' });
    const { id } = (await started.json()) as { id: string };
    const frames = [0, 1500, 1540, 3000].map((time, i) => ({ time, faps: { 3: i < 2 ? 0 : 900 } }));
    expect((await post('/takes/frames', { frames })).status).toBe(202);
    const stopped = await fetch(`${server.url}/v1/recordings/${id}/stop`, { method: 'POST' });
    expect(stopped.status).toBe(200);

    const studio = await StudioPage.open(browser, server.url);
    const { page } = studio;
    const section = page.locator('.recordings');
    await studio.waitForStage('ready');
    await page.locator('#tab-live').click();
    await section.getByLabel('Stream to record').selectOption({ label: 'Takes' });
    const item = section.locator('.recording');
    await item.getByRole('button', { name: /^More of/ }).click();
    const seek = item.getByRole('slider');
    await seek.fill('100');
    await page.locator('.driver').getByText('0:00.1 of A yawn').waitFor();
    const shut = await studio.pictureAtRest();
    await seek.fill('2500');
    await page.locator('.driver').getByText('0:02.5 of A yawn').waitFor();
    await studio.pictureUnlike(shut, faceAlone, 0.5);

    for (const [name, width, height] of [['wide', 1440, 900], ['narrow', 390, 844]] as const) {
      await page.setViewportSize({ width, height });
      for (const scheme of ['light', 'dark'] as const) {
        await page.emulateMedia({ colorScheme: scheme });
        await section.scrollIntoViewIfNeeded();
        await studio.keep(`recordings-${name}-${scheme}`);
        const wider = await page.evaluate(() =>
          [...document.querySelectorAll<HTMLElement>('.panel.live, .panel.live .recording, .panel.live .recordings')]
            .filter(({ scrollWidth, clientWidth }) => scrollWidth > clientWidth)
            .map(({ className }) => className),
        );
        expect(wider).toEqual([]);
      }
    }

    await item.getByRole('button', { name: /^Delete/ }).click();
    await page.getByRole('dialog').getByRole('button', { name: 'Delete' }).click();
    await section.getByText('Nothing recorded yet.').waitFor();
    expect((await fetch(`${server.url}/v1/recordings/${id}`)).status).toBe(404);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

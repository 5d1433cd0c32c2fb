import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Locator, Page } from 'playwright-core';
import { afterAll, describe, expect, test } from 'vitest';
import { buildDir, root } from './support/paths.ts';
import { eventually } from './support/patience.ts';
import { StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

const folder = mkdtempSync(join(tmpdir(), 'semblante-code-'));

useStudio({ demo: false, voice: join(buildDir, 'bin/semblante-voice-espeak') });
afterAll(async () => {
  rmSync(folder, { recursive: true, force: true });
});

mkdirSync(join(folder, 'include'));
symlinkSync(join(root, 'clients/runtime'), join(folder, 'include/semblante'));

/** What a program prints; an error with its output when it fails. */
const run = (program: string, args: string[], env: Record<string, string> = {}): string =>
  execFileSync(program, args, { encoding: 'utf8', cwd: folder, env: { ...process.env, ...env }, maxBuffer: 64e6, stdio: 'pipe' });

interface Frame {
  viseme: { select1: number };
  expression: { select1: number; intensity1: number };
  faps: Record<string, number>;
}

/** The face that is recorded of a stream while `act` runs. */
async function recordedFace(stream: string, act: () => void): Promise<Frame> {
  const request = async (path: string, method = 'GET'): Promise<Record<string, unknown>> => {
    const body = method === 'POST' ? { body: '{}', headers: { 'Content-Type': 'application/json' } } : {};
    const response = await fetch(`${server.url}/v1/${path}`, { method, ...body });
    if (!response.ok) throw new Error(await response.text());
    return (await response.json()) as Record<string, unknown>;
  };
  const { id } = await request(`streams/${stream}/recordings`, 'POST');
  act();
  await eventually('a frame is recorded', async () => Number((await request(`recordings/${String(id)}`))['frames']) > 0);
  await request(`recordings/${String(id)}/stop`, 'POST');
  const { frames } = (await request(`recordings/${String(id)}/frames`)) as { frames: Frame[] };
  return frames.at(-1)!;
}

/** Records a stream that says something, with its sound. */
async function recordSpeech(): Promise<void> {
  const post = async (path: string, body: object): Promise<{ id: string }> => {
    const response = await fetch(`${server.url}/v1/${path}`, { method: 'POST', body: JSON.stringify(body), headers: { 'Content-Type': 'application/json' } });
    if (!response.ok) throw new Error(await response.text());
    return (await response.json()) as { id: string };
  };
  const { id: stream } = await post('streams', { title: 'Speaking', model: 'sample' });
  const { id } = await post(`streams/${stream}/recordings`, {});
  await post(`streams/${stream}/speech`, { text: 'Hello.', language: 'en' });
  await eventually('it is recorded', async () => {
    const { duration } = (await (await fetch(`${server.url}/v1/recordings/${id}`)).json()) as { duration: number };
    return duration > 300;
  });
  await post(`recordings/${id}/stop`, {});
}

/** Viseme 10 with joy at its strongest and FAP 31 moved, by hand. */
async function makeFace(page: Page): Promise<void> {
  await page.locator('.viseme[data-viseme="10"]').click();
  await page.locator('.feeling-button[data-expression="1"]').click();
  await page.getByLabel('Search face parameters').fill('31');
  const slider = page.locator('.fap-list .slider:visible input[type="number"]').first();
  await slider.fill('100');
  await slider.press('Enter');
}

async function programOf(dialog: Locator, language: string): Promise<string> {
  await dialog.getByRole('button', { name: language, exact: true }).click();
  return (await dialog.getByLabel('Program', { exact: true }).textContent())!;
}

describe('code to copy', () => {
  test('TheFaceOnTheStage_EachProgramMakesIt', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 1440, height: 900 });
    const { page } = studio;
    await studio.waitForStage('ready');
    await makeFace(page);
    await page.getByRole('button', { name: 'Code' }).click();
    const dialog = page.getByRole('dialog', { name: 'Programs to copy' });
    await dialog.getByText('There is no stream to send into yet.').waitFor();
    await dialog.getByRole('button', { name: 'Create a new stream' }).click();
    await dialog.getByLabel('Stream').waitFor();
    const stream = await dialog.getByLabel('Stream').inputValue();
    await studio.keep('code-wide');

    const curl = await programOf(dialog, 'curl');
    const javascript = await programOf(dialog, 'JavaScript');
    writeFileSync(join(folder, 'pose.mjs'), javascript);
    for (const act of [() => run('bash', ['-c', curl]), () => run('node', ['pose.mjs'])]) {
      const { viseme, expression, faps } = await recordedFace(stream, act);
      expect(viseme.select1).toBe(10);
      expect(expression).toMatchObject({ select1: 1, intensity1: 63 });
      expect(Object.keys(faps)).toEqual(['31', '32']);
      expect(Math.abs(faps['31']! - 100)).toBeLessThan(10);
    }

    // The two programs that deform must give the vertices that this page shows.
    const shown = await page.evaluate(() => {
      const { kernel, poseNumber } = (window as unknown as Face).semblante.scene.performer.value;
      kernel.deform(poseNumber);
      return [...kernel.positions];
    });
    const library = join(buildDir, 'lib');
    const python = await programOf(dialog, 'Python');
    const c = await programOf(dialog, 'C');
    await studio.keep('code-c-wide');
    writeFileSync(join(folder, 'pose.py'), python);
    writeFileSync(join(folder, 'pose.c'), c);
    run('bash', ['-c', /curl .*/.exec(c)![0]]);
    const flags = ['-Wall', '-Wextra', '-Werror', '-Iinclude', `-I${root}`, `-L${library}`, '-lsemblante', `-Wl,-rpath,${library}`];
    run(process.env['CC'] ?? 'cc', ['pose.c', ...flags, '-o', 'pose']);
    const outputs = [
      run('./pose', []),
      run('python3', ['pose.py'], { PYTHONPATH: join(root, 'clients/python'), SEMBLANTE_LIBRARY: join(library, 'libsemblante.so') }),
    ];
    for (const output of outputs) {
      const numbers = output.trim().split(/\s+/).map(Number);
      expect(numbers.length).toBe(shown.length);
      const size = Math.max(...shown.map(Math.abs));
      const worst = Math.max(...numbers.map((value, i) => Math.abs(value - shown[i]!)));
      expect(worst / size).toBeLessThan(1e-4);
    }
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('ClipsAndRecordings_EachProgramSavesThem', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 1440, height: 900 });
    const { page } = studio;
    await studio.waitForStage('ready');
    await makeFace(page);
    const open = async (topic: string): Promise<Locator> => {
      await page.getByRole('button', { name: 'Code' }).click();
      const opened = page.getByRole('dialog', { name: 'Programs to copy' });
      await opened.getByLabel('Program for').selectOption(topic);
      return opened;
    };
    // What can do nothing yet says why, and leads to what helps.
    const { recordings } = (await (await fetch(`${server.url}/v1/recordings`)).json()) as { recordings: { id: string }[] };
    for (const { id } of recordings) await fetch(`${server.url}/v1/recordings/${id}`, { method: 'DELETE' });
    let dialog = await open('recording');
    await dialog.getByText('Nothing has been recorded yet.').waitFor();
    await dialog.getByRole('button', { name: 'Record in the Live tab' }).click();
    await page.locator('#tab-live[aria-selected="true"]').waitFor();
    await recordSpeech();
    await page.locator('#tab-animate').click();

    /** Runs the program of each language but C; the files that they save. */
    const files = async (file: string): Promise<Buffer[]> => {
      const made: Buffer[] = [];
      for (const [language, script, act] of [
        ['curl', 'motion.sh', () => run('bash', ['motion.sh'])],
        ['JavaScript', 'motion.mjs', () => run('node', ['motion.mjs'])],
        ['Python', 'motion.py', () => run('python3', ['motion.py'])],
      ] as const) {
        writeFileSync(join(folder, script), await programOf(dialog, language));
        act();
        made.push(readFileSync(join(folder, file)));
        rmSync(join(folder, file));
      }
      return made;
    };
    dialog = await open('clip');
    const clips = await files('clip.glb');
    for (const clip of clips) expect(clip.equals(clips[0]!)).toBe(true);
    const gltf = JSON.parse(clips[0]!.subarray(20, 20 + clips[0]!.readUInt32LE(12)).toString()) as { animations: object[]; accessors: { max?: number[] }[] };
    expect(gltf.animations).toHaveLength(1);
    await studio.keep('code-clip');

    // In C every moment of the clip: the first and the last are at rest, the one in the middle is not.
    const library = join(buildDir, 'lib');
    const flags = ['-Wall', '-Wextra', '-Werror', '-Iinclude', `-I${root}`, `-L${library}`, '-lsemblante', `-Wl,-rpath,${library}`];
    const momentsOf = async (): Promise<string[]> => {
      const source = await programOf(dialog, 'C');
      writeFileSync(join(folder, 'motion.c'), source);
      run('bash', ['-c', /curl .*/.exec(source)![0]]);
      run(process.env['CC'] ?? 'cc', ['motion.c', ...flags, '-o', 'motion']);
      const lines = run('./motion', []).trim().split('\n');
      const count = await page.evaluate(() => (window as unknown as Inside).semblante.scene.face!.mesh.vertexCount);
      expect(lines.length % count).toBe(0);
      return Array.from({ length: lines.length / count }, (_, i) => lines.slice(i * count, (i + 1) * count).join());
    };
    const moments = await momentsOf();
    expect(moments).toHaveLength(51);
    expect(moments[0]).toBe(moments[50]);
    expect(moments[25]).not.toBe(moments[0]);
    await page.keyboard.press('Escape');

    dialog = await open('recording');
    const starts = { performance: '{', fap: '', 'arkit-csv': 'Timecode', glb: 'glTF', opus: 'OggS', 'frames-json': '{' };
    const endings = { performance: '.json', fap: '.fap', 'arkit-csv': '.csv', glb: '.glb', opus: '.opus', 'frames-json': '.frames.json' };
    for (const format of ['glb', 'opus', 'performance', 'fap', 'arkit-csv', 'frames-json'] as const) {
      await dialog.getByLabel('Format').selectOption(format);
      for (const content of await files(`recording${endings[format]}`)) {
        expect(content.length, format).toBeGreaterThan(100);
        expect(content.subarray(0, starts[format].length).toString(), format).toBe(starts[format]);
      }
    }
    expect((await momentsOf()).length).toBeGreaterThan(5);
    await studio.keep('code-recording');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Keyboard_OpensChoosesCopiesAndCloses', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 390, height: 844, dark: true });
    const { page } = studio;
    await studio.context.grantPermissions(['clipboard-read', 'clipboard-write']);
    await studio.waitForStage('ready');
    await page.getByRole('button', { name: 'Code' }).focus();
    await page.keyboard.press('Enter');
    const dialog = page.getByRole('dialog', { name: 'Programs to copy' });
    await dialog.getByRole('button', { name: 'Python' }).focus();
    await page.keyboard.press('Space');
    await dialog.getByText('Computes the vertices of this head').waitFor();
    // A redraw keeps the focus on the chosen language.
    expect(await page.evaluate(() => document.activeElement?.textContent)).toBe('Python');
    await page.keyboard.press('Tab');
    await page.keyboard.press('Tab');
    expect(await page.evaluate(() => document.activeElement?.tagName)).toBe('PRE');
    await page.keyboard.press('Tab');
    await page.keyboard.press('Enter');
    await dialog.getByText('Copied.').waitFor();
    expect(await page.evaluate(() => navigator.clipboard.readText())).toContain('semblante.fetch_head(');
    await studio.keep('code-narrow');
    const box = (await dialog.boundingBox())!;
    expect(box.x).toBeGreaterThanOrEqual(0);
    expect(box.x + box.width).toBeLessThanOrEqual(390);
    for (const button of await dialog.getByRole('button').all()) expect((await button.boundingBox())!.height).toBeGreaterThanOrEqual(44);
    await page.keyboard.press('Escape');
    expect(await page.locator('dialog').count()).toBe(0);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

interface Face {
  semblante: {
    scene: { performer: { value: { poseNumber: number; kernel: { deform(pose: number): void; positions: Float32Array } } } };
  };
}

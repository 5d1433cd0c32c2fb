import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { fitsThePage } from './support/checks/fits_the_page.ts';
import { english, noEnglish } from './support/checks/no_english.ts';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio();

async function open(width: number, height: number): Promise<StudioPage> {
  const studio = await StudioPage.open(browser, server.url, { width, height, locale: 'pt-BR' });
  await studio.waitForStage('ready');
  return studio;
}

const language = (studio: StudioPage): Promise<string> => studio.page.evaluate(() => document.documentElement.lang);

describe('languages', () => {
  test('Language_PortugueseBrowser_NoEnglishOnAnyTabOfAWidePage', async () => {
    const studio = await open(1440, 900);
    const { page } = studio;
    expect(await language(studio)).toBe('pt-BR');
    for (const tab of ['animate', 'fit', 'points', 'live']) {
      await page.locator(`#tab-${tab}`).click();
      await studio.drawn(3);
      await studio.keep(`portuguese-wide-${tab}`);
      expect(await noEnglish.faults(studio), tab).toEqual([]);
      expect(await fitsThePage.faults(studio), tab).toEqual([]);
    }
    // Digits are grouped as in Brazil.
    await page.getByText('11.478').first().waitFor({ state: 'attached' });
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Language_FindingsRemarksAndRefusals_AreInPortuguese', async () => {
    const odd = ['v 0 0 0', 'v 1 0 0', 'v 0 1 0', 'v 0 0 1', 'v 0 0 -1', 'v 9 9 9', 'f 1 2 3', 'f 1 2 4', 'f 1 2 5', 'f 1 3 4'].join('\n');
    const made = await fetch(`${server.url}/v1/models?name=Odd`, { method: 'POST', headers: { 'Content-Type': 'model/obj' }, body: odd });
    const { model } = (await made.json()) as { model: { id: string } };
    const studio = await StudioPage.open(browser, `${server.url}/#${model.id}/fit`, { width: 1100, height: 700, locale: 'pt-BR', allowed: /status of 404/ });
    const { page } = studio;
    await page.locator('.finding').nth(1).waitFor();
    const said = await page.locator('.finding').allInnerTexts();
    expect(said.join('\n')).not.toMatch(english);
    await studio.keep('portuguese-findings');
    // Remarks on the file, and why its axes are uncertain.
    for (const list of ['.remarks li', '.reasons li']) {
      await page.locator(list).filter({ hasText: 'eixos' }).first().waitFor();
      const remarks = await page.locator(list).allInnerTexts();
      expect(remarks.length).toBeGreaterThan(1);
      expect(remarks.join('\n')).not.toMatch(english);
    }
    const folder = mkdtempSync(join(tmpdir(), 'semblante-words-'));
    writeFileSync(join(folder, 'carta.glb'), 'Cara Ana, esta é a cabeça.');
    await studio.drop(join(folder, 'carta.glb'));
    const refused = page.locator('.stage-card.error');
    await refused.getByText("não é um arquivo GLB: não começa com 'glTF'").waitFor();
    expect(await refused.innerText()).not.toMatch(english);
    // The place in the file, and a sentence with words of the server filled in.
    writeFileSync(join(folder, 'careta.obj'), ['v 0 0 0', 'v 1 0 0', 'v 0 1 0', 'vt 0 0', 'f 1/9 2/1 3/1'].join('\n'));
    await studio.drop(join(folder, 'careta.obj'));
    await refused.getByText('f cita a coordenada de textura 9, mas há 1').waitFor();
    await refused.getByText('linha 5').waitFor();
    expect(await refused.innerText()).not.toMatch(english);
    await studio.keep('portuguese-refusal');
    rmSync(folder, { recursive: true });
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Language_Chosen_IsKeptByTheBrowser', async () => {
    const studio = await open(880, 560);
    const { page } = studio;
    await page.getByLabel('Idioma', { exact: true }).selectOption('en');
    await page.getByLabel('Language', { exact: true }).waitFor();
    await page.locator('#tab-live').getByText('Live', { exact: true }).waitFor();
    expect(await language(studio)).toBe('en');
    await page.reload();
    await page.getByLabel('Language', { exact: true }).waitFor();
    expect(await language(studio)).toBe('en');
    await page.getByLabel('Language', { exact: true }).selectOption('pt-BR');
    await page.getByLabel('Idioma', { exact: true }).waitFor();
    await studio.waitForStage('ready');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

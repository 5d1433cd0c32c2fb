import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { sampleHead, samplePoints } from './support/paths.ts';
import { StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

const known = (
  JSON.parse(readFileSync(samplePoints, 'utf8')) as { points: Record<string, { position: [number, number, number] }> }
).points;

useStudio({ demo: false });

const selected = (studio: StudioPage): Promise<string> =>
  studio.page.evaluate(() => (window as unknown as Inside).semblante.studio.selected.value!.id);

async function mark(studio: StudioPage, ids: readonly string[]): Promise<void> {
  for (const id of ids) {
    const spot = await studio.project(known[id]!.position);
    await studio.page.mouse.click(spot.x, spot.y);
  }
}

describe('nothing is lost', () => {
  test('Draft_ReloadAndAnotherHead_IsBackUntilItIsDiscarded', async () => {
    const studio = await StudioPage.open(browser, server.url, { width: 1280, height: 720 });
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.locator('[data-model=sample] .thumb img').waitFor();
    await studio.drop(sampleHead, 'draft.glb');
    await studio.waitForState('ready');
    await studio.waitForStage('ready');
    await page.locator('#tab-points').click();
    const head = await selected(studio);
    await page.getByRole('button', { name: 'Start' }).click();
    await mark(studio, ['9.3', '9.15']);
    await page.getByText('2 of 84 placed').waitFor();

    await page.reload();
    await page.getByText('Your 2 unsaved points are back.').waitFor();
    await page.locator('[data-model=sample]:not(.selected) .thumb img').waitFor(); // its picture too
    expect(await selected(studio)).toBe(head);
    await page.getByText('2 of 84 placed').waitFor();
    await page.getByRole('button', { name: 'Save 2 changes' }).waitFor();

    // Another head and back.
    await page.locator('[data-model=sample] button').first().click();
    await page.locator('#tab-animate[aria-selected=true]').waitFor();
    await page.goBack();
    await page.getByText('2 of 84 placed').waitFor();
    expect(await selected(studio)).toBe(head);

    // Discarding is a step that can be undone.
    await page.getByRole('button', { name: 'Discard' }).last().click();
    await page.getByText('0 of 84 placed').waitFor();
    await page.keyboard.press('Control+z');
    await page.getByText('2 of 84 placed').waitFor();

    // What is saved is no draft any more.
    await page.getByRole('button', { name: 'Save 2 changes' }).click();
    await page.getByRole('button', { name: 'Saved' }).waitFor();
    expect(await page.evaluate((id) => localStorage.getItem(`semblante.draft.${id}`), head)).toBeNull();
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Points_TwoPeopleAtOneHead_SeeEachOthersChangesOrChoose', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/points`, { width: 1280, height: 720 });
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.getByRole('button', { name: 'Saved' }).waitFor();
    const url = `${server.url}/v1/models/sample/feature-points`;
    const patch = async (id: string, by: number): Promise<void> => {
      const [x, y, z] = known[id]!.position;
      const body = JSON.stringify({ points: { [id]: { position: [x, y + by, z] } } });
      expect((await fetch(url, { method: 'PATCH', body, headers: { 'Content-Type': 'application/json' } })).ok).toBe(true);
    };
    const shown = (id: string): Promise<number> =>
      page.evaluate((point) => {
        const { scene } = (window as unknown as { semblante: { scene: { markers: { of(id: string): { position: number[] } } } } }).semblante;
        return scene.markers.of(point).position[1]!;
      }, id);

    // Another person moves a point: it is shown here.
    const before = await shown('2.1');
    await patch('2.1', -0.01);
    await page.getByText('Someone else changed 1 point.').waitFor();
    expect(await shown('2.1')).toBeLessThan(before - 0.005);
    await page.getByRole('button', { name: 'Saved' }).waitFor();

    // Both move the same point: this page shows its own place until the user has chosen one.
    await page.locator('[data-point="2.1"]').click();
    await mark(studio, ['2.1']);
    await page.getByRole('button', { name: 'Save 1 change' }).waitFor();
    const mine = await shown('2.1');
    await patch('2.1', -0.02);
    await page.getByText('Someone else changed too: 2.1. Yours is shown.').waitFor();
    expect(await shown('2.1')).toBe(mine);
    await studio.keep('two-people');
    await page.getByRole('button', { name: 'Take theirs' }).click();
    await page.getByRole('button', { name: 'Saved' }).waitFor();
    expect(await shown('2.1')).toBeLessThan(before - 0.015);
    await page.keyboard.press('Control+z');
    await page.getByRole('button', { name: 'Save 1 change' }).click();
    await page.getByRole('button', { name: 'Saved' }).waitFor();
    expect(await shown('2.1')).toBeCloseTo(mine, 4);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Address_HeadTabPointAndStream_AreNamedAndComeBack', async () => {
    const studio = await StudioPage.open(browser, server.url, { width: 1280, height: 720 });
    const { page } = studio;
    await studio.waitForStage('ready');
    const hash = (): Promise<string> => page.evaluate(() => location.hash);
    await page.waitForFunction(() => location.hash === '#sample/animate');
    expect(await page.title()).toContain('Semblante');

    await page.locator('#tab-points').click();
    await page.getByRole('button', { name: 'All 84' }).click();
    await page.locator('[data-point="8.1"]').click();
    await page.waitForFunction(() => location.hash === '#sample/points?point=8.1');
    await page.locator('[data-point="2.1"]').click();
    await page.waitForFunction(() => location.hash === '#sample/points?point=2.1');
    await page.locator('#tab-fit').click();
    await page.waitForFunction(() => location.hash === '#sample/fit');

    await page.goBack();
    await page.waitForFunction(() => location.hash === '#sample/points?point=2.1');
    expect(await page.locator('[data-point="2.1"]').getAttribute('aria-pressed')).toBe('true');
    await page.goBack();
    await page.locator('#tab-animate[aria-selected=true]').waitFor();
    await page.goForward();
    await page.locator('[data-point="2.1"][aria-pressed=true]').waitFor();

    // A link that is sent, with a stream.
    const stream = (await (
      await fetch(`${server.url}/v1/streams`, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify({ title: 'mine' }) })
    ).json()) as { id: string };
    const other = await StudioPage.open(browser, `${server.url}/#sample/live?stream=${stream.id}`, { width: 1280, height: 720 });
    await other.waitForStage('ready');
    await other.page.locator('#tab-live[aria-selected=true]').waitFor();
    await other.page.waitForFunction((id) => (window as unknown as Inside).semblante.live.following.value === id, stream.id);
    expect(await other.page.evaluate(() => location.hash)).toBe(`#sample/live?stream=${stream.id}`);
    expect(await hash()).toBe('#sample/points?point=2.1');
    expect([...studio.errors, ...other.errors]).toEqual([]);
    await studio.close();
    await other.close();

    // Another client uploads a head; its link is opened in a page that has not heard of it.
    const late = await StudioPage.open(browser, server.url, { width: 1280, height: 720 });
    await late.waitForStage('ready');
    const { model } = (await (
      await fetch(`${server.url}/v1/models?name=Late&filename=late.glb`, { method: 'POST', body: readFileSync(sampleHead), headers: { 'Content-Type': 'model/gltf-binary' } })
    ).json()) as { model: { id: string } };
    await late.page.evaluate((id) => (location.hash = `#${id}/points`), model.id);
    await late.page.waitForFunction((id) => (window as unknown as Inside).semblante.studio.selected.value?.id === id, model.id);
    await late.page.locator('#tab-points[aria-selected=true]').waitFor();
    await late.waitForStage('ready');
    // The other client deletes it again.
    await fetch(`${server.url}/v1/models/${model.id}`, { method: 'DELETE' });
    await late.page.getByText('Late was deleted elsewhere.').waitFor();
    await late.page.waitForFunction(() => (window as unknown as Inside).semblante.studio.selected.value?.id === 'sample');
    expect(late.errors).toEqual([]);
    await late.close();

    const lost = await StudioPage.open(browser, `${server.url}/#nobody/points?point=9.9&stream=x`, { width: 1280, height: 720 });
    await lost.page.getByText('The head of this address is not on the server.').waitFor();
    await lost.waitForStage('ready');
    expect(lost.errors).toEqual([]);
    await lost.close();
  });
});

import { expect, test } from 'vitest';
import { phone, StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });

test('Studio_ServerWithoutADemo_WaitsForNoStream', async () => {
  const studio = await StudioPage.open(browser, server.url);
  await studio.waitForStage('ready');
  const chip = studio.page.locator('.driver');
  await chip.getByText('By hand').waitFor();
  expect(await chip.getByRole('button').count()).toBe(0);
  expect(studio.errors).toEqual([]); // a request for a stream that is not there is one
  await studio.close();
});

test('Studio_ManyHeads_TheStepsStayInSight', async () => {
  const studio = await StudioPage.open(browser, 'about:blank', { width: 1280, height: 720 });
  const { page } = studio;
  await page.route('**/v1/models?**', async (route) => {
    if (route.request().method() !== 'GET') return route.continue();
    const answer = await route.fetch();
    const list = (await answer.json()) as { models: { id: string; name: string }[] };
    const sample = list.models.at(-1)!;
    list.models = [...Array.from({ length: 30 }, (_, i) => ({ ...sample, id: `head${i}`, name: `Head ${i}` })), ...list.models];
    await route.fulfill({ response: answer, json: list });
  });
  await page.goto(`${server.url}/#sample/animate`);
  await studio.waitForStage('ready');
  const bottom = async (selector: string): Promise<number> => {
    const box = (await page.locator(selector).boundingBox())!;
    return box.y + box.height;
  };
  expect(await bottom('.steps')).toBeLessThanOrEqual(720);
  expect(await bottom('.shelf-panel > .drop')).toBeLessThanOrEqual(720);
  const inSight = (name: string): Promise<unknown> =>
    page.waitForFunction((name) => {
      const open = document.querySelector('.head.selected');
      if (!open?.textContent?.includes(name)) return false;
      const [list, item] = [open.closest('.heads')!, open].map((element) => element.getBoundingClientRect());
      return item!.top >= list!.top - 1 && item!.bottom <= list!.bottom + 1;
    }, name);
  // The open head is the last of the list: it is scrolled to.
  await inSight('Sample head');
  await studio.keep('many-heads');
  // So is one that comes, wherever the person has scrolled to.
  await page.locator('.heads').evaluate((list) => list.scrollTo(0, 0));
  await studio.dropText('wedge.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n');
  await inSight('wedge');
  const wedge = await page.evaluate(() => (window as unknown as Inside).semblante.studio.selected.value!.id);
  expect(studio.errors).toEqual([]);
  await studio.close();
  await fetch(`${server.url}/v1/models/${wedge}`, { method: 'DELETE' });
});

test('Studio_EmptyServer_OffersTheSampleAndLeadsToItsPlay', async () => {
  await fetch(`${server.url}/v1/models/sample`, { method: 'DELETE' });
  const studio = await StudioPage.open(browser, server.url, { width: 1280, height: 720 });
  const { page } = studio;
  const done = (): Promise<number> => page.locator('.steps-list .done').count();
  await page.getByText('No heads yet.').first().waitFor();
  expect(await done()).toBe(0);
  await studio.keep('empty-server');
  await page.locator('#tab-points').click();
  await page.getByText('Open a head first').waitFor();
  expect(await page.getByRole('button', { name: 'Start' }).count(), 'there is nothing to place points on').toBe(0);
  await page.locator('#tab-animate').click();
  const touched = await StudioPage.open(browser, server.url, phone);
  await touched.page.getByText('Upload a file (').waitFor();
  expect(await touched.page.locator('#panel-animate .drop').first().innerText(), 'a finger drops no files').toBe('Your own recording');
  await touched.close();
  await page.getByRole('button', { name: 'Try the sample head' }).click();
  await studio.waitForState('parametrized');
  await studio.waitForStage('ready');
  await page.locator('#tab-animate[aria-selected=true]').waitFor();
  expect(await done()).toBe(3);
  await page.getByRole('button', { name: 'Play a minute' }).click();
  await page.getByRole('button', { name: 'Pause the example' }).waitFor();
  expect(await page.evaluate(() => (window as unknown as Inside).semblante.driver.source.value)).toBe('clip');
  expect(await done()).toBe(4);
  await studio.keep('example-plays');
  await page.getByRole('button', { name: 'Pause the example' }).click();
  await page.getByRole('button', { name: 'Play a minute' }).waitFor();

  // On a phone it stands above the panel, until all is done.
  const small = await StudioPage.open(browser, server.url, phone);
  await small.waitForStage('ready');
  await small.page.getByRole('button', { name: 'Play a minute' }).waitFor();
  await small.keep('steps-phone');
  expect([...studio.errors, ...small.errors]).toEqual([]);
  await small.close();
  await studio.close();
});

import { expect, test } from 'vitest';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });

test('Studio_ServerWithoutADemo_WaitsForNoStream', async () => {
  const studio = await StudioPage.open(browser, server.url, { coarse: true });
  await studio.waitForStage('ready');
  const chip = studio.page.locator('.driver');
  await chip.getByText('By hand').waitFor();
  expect(await chip.getByRole('button').count()).toBe(0);
  expect(studio.errors).toEqual([]); // a request for a stream that is not there is one
  await studio.close();
});

import { describe, expect, test } from 'vitest';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio();

const sizes = [
  { name: 'wide', width: 1440, height: 900 },
  { name: 'narrow', width: 390, height: 844 },
];
const tabs = ['animate', 'fit', 'points', 'live'] as const;

describe('look', () => {
  for (const { name, width, height } of sizes) {
    for (const dark of [false, true]) {
      test(`Studio_${name}${dark ? 'Dark' : 'Light'}_FitsThePage`, async () => {
        const studio = await StudioPage.open(browser, server.url, { width, height, dark });
        await studio.waitForStage('ready');
        for (const tab of tabs) {
          await studio.page.locator(`#tab-${tab}`).click();
          // No element overflows horizontally, and the page itself does not scroll.
          const overflow = (): Promise<number[]> =>
            studio.page.evaluate(() => [
              document.documentElement.scrollWidth - innerWidth,
              document.documentElement.scrollHeight - innerHeight,
            ]);
          await studio.drawn(3);
          expect(await overflow()).toEqual([0, 0]);
          await studio.keep(`${name}-${dark ? 'dark' : 'light'}-${tab}`);
        }
        expect(studio.errors).toEqual([]);
        await studio.close();
      });
    }
  }

  test('Studio_EveryControl_HasAName', async () => {
    const studio = await StudioPage.open(browser, server.url);
    await studio.waitForStage('ready');
    const nameless = await studio.page.evaluate(() =>
      [...document.querySelectorAll<HTMLElement>('button, input, select')]
        .filter((element) => {
          const label = element.getAttribute('aria-label') ?? element.textContent?.trim() ?? '';
          const labelled = element.id !== '' && document.querySelector(`label[for="${element.id}"]`) !== null;
          return label === '' && !labelled && element.closest('label') === null;
        })
        .map((element) => element.outerHTML.slice(0, 120)),
    );
    expect(nameless).toEqual([]);
    await studio.close();
  });
});

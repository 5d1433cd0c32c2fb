import type { Check } from './check.ts';

/** Every control has a name, also one that is not shown now, which axe does not look at. */
export const controlsHaveNames: Check = {
  name: 'ControlsHaveNames',
  faults: ({ page }) =>
    page.evaluate(() =>
      [...document.querySelectorAll<HTMLElement>('button, input, select')]
        .filter((element) => {
          const label = element.getAttribute('aria-label') ?? element.textContent?.trim() ?? '';
          const labelled = element.id !== '' && document.querySelector(`label[for="${element.id}"]`) !== null;
          return label === '' && !labelled && element.closest('label') === null;
        })
        .map((element) => element.outerHTML.slice(0, 120)),
    ),
};

import type { Check } from './check.ts';

/** The page does not scroll, but downwards at four times its size (layout.css); no panel or dialog is wider than its place, and the buttons of a dialog are seen. */
export const fitsThePage: Check = {
  name: 'FitsThePage',
  faults: ({ page }) =>
    page.evaluate(() => {
      const { scrollWidth, scrollHeight } = document.documentElement;
      const wide = [...document.querySelectorAll('.panel, .panel-foot, dialog')].filter((one) => one.scrollWidth > one.clientWidth);
      const hidden = [...document.querySelectorAll('dialog[open] > form > .row.end')].filter((one) => one.getBoundingClientRect().bottom > innerHeight);
      const isLow = matchMedia('(max-width: 560px) and (min-aspect-ratio: 5/4)').matches;
      return [
        ...hidden.map((one) => `the buttons of a dialog are below its end: ${one.textContent}`),
        ...(scrollWidth === innerWidth ? [] : [`the page is ${scrollWidth} pixels wide, the window ${innerWidth}`]),
        ...(isLow || scrollHeight === innerHeight ? [] : [`the page is ${scrollHeight} pixels high, the window ${innerHeight}`]),
        ...wide.map((one) => `${one.tagName} ${one.id} ${one.className}: ${one.scrollWidth} pixels in ${one.clientWidth}`),
      ];
    }),
};

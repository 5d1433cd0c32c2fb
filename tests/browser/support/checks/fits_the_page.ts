import type { Check } from './check.ts';

/** The page does not scroll, and no panel or dialog is wider than its place. */
export const fitsThePage: Check = {
  name: 'FitsThePage',
  faults: ({ page }) =>
    page.evaluate(() => {
      const { scrollWidth, scrollHeight } = document.documentElement;
      const wide = [...document.querySelectorAll('.panel, .panel-foot, dialog')].filter((one) => one.scrollWidth > one.clientWidth);
      return [
        ...(scrollWidth === innerWidth ? [] : [`the page is ${scrollWidth} pixels wide, the window ${innerWidth}`]),
        ...(scrollHeight === innerHeight ? [] : [`the page is ${scrollHeight} pixels high, the window ${innerHeight}`]),
        ...wide.map((one) => `${one.tagName} ${one.id} ${one.className}: ${one.scrollWidth} pixels in ${one.clientWidth}`),
      ];
    }),
};

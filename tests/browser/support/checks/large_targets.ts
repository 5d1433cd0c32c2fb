import type { Check } from './check.ts';

/** Every control is 44 pixels large under a finger, less what rounding takes. */
export const largeTargets: Check = {
  name: 'ControlsAre44PixelsLarge',
  isFor: ({ options }) => options.hasTouch === true,
  faults: ({ page }) =>
    page.evaluate(() => {
      const small: string[] = [];
      for (const control of document.querySelectorAll<HTMLElement>('button, input, select, summary, a[href], textarea, [role=button]')) {
        // The points in the drawing are too close together for fingers; the list below the drawing has each of them as a row.
        if (control.closest('.guide-drawing, .visually-hidden') || control.matches('.visually-hidden, .link')) continue;
        const label = control.closest('label') ?? (control.id === '' ? null : document.querySelector(`label[for="${control.id}"]`));
        const target = label && control.matches('[type=checkbox]') ? label : control;
        const { width, height } = target.getBoundingClientRect();
        if (width === 0 || height === 0 || !control.checkVisibility()) continue; // what is folded has a place, and no size of its own
        if (width < 43.9 || height < 43.9)
          small.push(`${control.tagName} ${control.className} ${control.textContent?.slice(0, 30)} ${Math.round(width)} x ${Math.round(height)}`);
      }
      return small;
    }),
};

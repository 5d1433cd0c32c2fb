import type { BrowserContextOptions } from 'playwright-core';
import { everyVariant } from './variants.ts';

/** A size of the page with a theme and a language. */
export interface Look {
  name: string;
  options: BrowserContextOptions;
}

const sizes = {
  wide: { viewport: { width: 1440, height: 900 } },
  laptop: { viewport: { width: 1024, height: 700 } },
  phone: { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true },
  /** A window of 1280 by 1024 pixels at four times the size. */
  zoomed: { viewport: { width: 320, height: 256 } },
} satisfies Record<string, BrowserContextOptions>;

const every: Look[] = Object.entries(sizes).flatMap(([size, options]) =>
  (['light', 'dark'] as const).flatMap((colorScheme) =>
    ['en-US', 'pt-BR'].map((locale) => ({
      name: `${size}-${colorScheme}-${locale.slice(0, 2)}`,
      options: { ...options, colorScheme, locale, reducedMotion: 'reduce' as const },
    })),
  ),
);

/** The usual looks have each theme and each language, those of `tests/run --browser` both themes at both sizes, and one at four times the size. */
const usual = ['wide-light-en', 'phone-dark-pt'];
const variants = [...usual, 'wide-dark-pt', 'phone-light-en', 'zoomed-light-en'];

/** Every screen in every look is kept as a picture, to be looked at by people. */
export const keepsPictures = process.env['SEMBLANTE_SCREENS'] === 'all';

/** The other tests keep pictures for people too. */
export const writesPictures = keepsPictures || process.env['SEMBLANTE_PICTURES'] === '1';

export const looks = every.filter(({ name }) => keepsPictures || (everyVariant ? variants : usual).includes(name));

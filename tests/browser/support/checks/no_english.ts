import type { Check } from './check.ts';

/** Words of the English page that no Portuguese sentence has. */
export const english = /\b(the|of|with|not|head|heads|points|frames|choose|and|stream|streams|save|guessed|placed|by)\b/gi;

/** A page in Portuguese has no English word, neither shown nor said to those who do not see it. */
export const noEnglish: Check = {
  name: 'HasNoEnglishWord',
  isFor: ({ options }) => options.locale === 'pt-BR',
  faults: async ({ page }) => {
    const said = await page.evaluate(() => {
      const texts = [...document.querySelectorAll<HTMLElement>('[aria-label], [title], [placeholder]')].map(
        (one) => `${one.getAttribute('aria-label') ?? ''} ${one.title} ${one.getAttribute('placeholder') ?? ''}`,
      );
      // Left out: names of heads, streams and parts, which their owners chose, and the texts of programs.
      const programs = [...document.querySelectorAll<HTMLElement>('pre, code')].map((one) => one.innerText).filter((text) => text !== '');
      const shown = programs.reduce((text, program) => text.replaceAll(program, ''), document.body.innerText);
      return [shown.replaceAll(/Sample head|Demo/g, ''), ...texts.filter((text) => !/Sample head|^Visema/.test(text))].join('\n');
    });
    return [...said.matchAll(english)].map(({ index }) => said.slice(Math.max(0, index - 30), index + 30));
  },
};

import type { CSSOptions } from 'vite';
import { rem } from './src/ui/shared/rem.ts';

const pixels = /(-?(?:\d*\.)?\d+)px\b/g;
const inRem = (css: string): string => css.replace(pixels, (_, length: string) => rem(Number(length)));

/**
 * The style sheets state sizes in pixels at letters of the usual size. In the page all of them, and the widths at which its
 * layout changes, follow the letters that the browser is set to, so that larger ones do what a zoom of the page does.
 */
export const followsLetters: CSSOptions = {
  postcss: {
    plugins: [
      {
        postcssPlugin: 'semblante-letters',
        Declaration: (declaration) => void (declaration.value = inRem(declaration.value)),
        AtRule: (rule) => void (rule.params = inRem(rule.params)),
      },
    ],
  },
};

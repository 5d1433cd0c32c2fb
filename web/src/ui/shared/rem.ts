/** Size of the letters, in pixels, that a browser has until somebody chooses another. */
const usualLetters = 16;

/** A length that grows with the letters that the browser is set to. `pixels`: at letters of the usual size. */
export const rem = (pixels: number): string => `${pixels / usualLetters}rem`;

/** How many times the usual size the letters of the page are. */
export const lettersScale = (): number => parseFloat(getComputedStyle(document.documentElement).fontSize) / usualLetters;

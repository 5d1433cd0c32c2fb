import type { Page } from 'playwright-core';

/** Mean red, green and blue at the middle of a picture (PNG), or above it by a share of the picture's height. */
export const middleOf = (page: Page, picture: Buffer, above = 0): Promise<number[]> =>
  page.evaluate(async ([base64, above]) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext('2d')!;
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(Math.floor(image.width / 2), Math.floor(image.height * (0.5 - above)), 4, 4);
    return [0, 1, 2].map((channel) => data.filter((_, i) => i % 4 === channel).reduce((sum, value) => sum + value, 0) / 16);
  }, [picture.toString('base64'), above] as const);

/** Whether a colour is clearly green. */
export const isGreen = ([red, green, blue]: number[]): boolean => green! - red! > 40 && green! - blue! > 40;

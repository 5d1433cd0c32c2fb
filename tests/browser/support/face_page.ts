import type { Page } from 'playwright-core';

/** What the page `/view/{stream}` tells of its face. */
export interface ShownFace {
  state: string;
  message: string;
  paused: boolean;
  stats: { vertices: number };
}

/** Waits until the face of a page is in one of these states. */
export async function untilFace(page: Page, ...states: string[]): Promise<void> {
  await page.waitForFunction(
    (wanted) => wanted.includes((window as unknown as { semblanteFace?: ShownFace }).semblanteFace?.state ?? ''),
    states,
  );
}

export const shownFace = (page: Page): Promise<ShownFace> =>
  page.evaluate(() => {
    const { state, message, paused, stats } = (window as unknown as { semblanteFace: ShownFace }).semblanteFace;
    return { state, message, paused, stats };
  });

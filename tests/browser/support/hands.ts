import type { FileChooser, Locator, Page } from 'playwright-core';
import type { StudioPage } from './studio_page.ts';

type Place = readonly [number, number, number];

/** How a person works the studio: with a mouse or a finger. Counts what it does. */
export interface Hand {
  /** Clicks or taps. */
  readonly acts: number;
  /** A button, tab or switch. */
  press(control: Locator): Promise<void>;
  /** The asked feature point at a place of the head, in model space. */
  placeAt(studio: StudioPage, position: Place): Promise<void>;
}

export async function chooseFile(page: Page, hand: Hand, control: Locator, path: string): Promise<void> {
  const [chooser] = (await Promise.all([page.waitForEvent('filechooser'), hand.press(control)])) as [FileChooser, void];
  await chooser.setFiles(path);
}

export class MouseHand implements Hand {
  acts = 0;

  async press(control: Locator): Promise<void> {
    this.acts += 1;
    await control.click();
  }

  async placeAt(studio: StudioPage, position: Place): Promise<void> {
    this.acts += 1;
    const { x, y } = await studio.project(position);
    await studio.page.mouse.click(x, y);
  }
}

export class FingerHand implements Hand {
  acts = 0;

  async press(control: Locator): Promise<void> {
    this.acts += 1;
    await control.tap();
  }

  async placeAt(studio: StudioPage, position: Place): Promise<void> {
    this.acts += 1;
    const { x, y } = await studio.project(position);
    await studio.page.touchscreen.tap(x, y);
  }
}

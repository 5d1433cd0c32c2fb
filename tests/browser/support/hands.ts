import type { FileChooser, Locator, Page } from 'playwright-core';
import type { StudioPage } from './studio_page.ts';

type Place = readonly [number, number, number];

/**
 * Seconds of single acts after the Keystroke-Level Model (Card, Moran and Newell, 1980), so that the time of a way through the
 * studio does not depend on the machine: what the page and the server take is not in it, nor the file chooser, which is the
 * system's. `read`: a sentence of twelve words at 238 words a minute (Brysbaert, 2019), since nobody knows the studio yet.
 */
const human = { decide: 1.35, key: 0.28, point: 1.1, click: 0.2, read: 3 };
/** Keys that repeat while held: the wait before the first repetition, and between two, seconds. */
const repeating = { first: 0.5, next: 1 / 30 };

/** How a person works the studio: with a mouse, a finger or the keyboard. Counts what it does. */
export interface Hand {
  /** Clicks, taps or, on the keyboard, controls pressed and points placed. */
  readonly acts: number;
  /** Keys pressed; a held key is one. */
  readonly keys: number;
  /** What a person needs for it, seconds. */
  readonly seconds: number;
  /** A button, tab or switch. */
  press(control: Locator): Promise<void>;
  /** The asked feature point at a place of the head, in model space. */
  placeAt(studio: StudioPage, position: Place): Promise<void>;
}

export async function chooseFile(page: Page, hand: Hand, control: Locator, path: string): Promise<void> {
  const [chooser] = (await Promise.all([page.waitForEvent('filechooser'), hand.press(control)])) as [FileChooser, void];
  await chooser.setFiles(path);
}

/** A hand that points at what it means. */
abstract class PointingHand implements Hand {
  acts = 0;
  readonly keys = 0;
  seconds = 0;

  press(control: Locator): Promise<void> {
    this.act(0);
    return this.touch(control);
  }

  async placeAt(studio: StudioPage, position: Place): Promise<void> {
    this.act(human.read);
    const { x, y } = await studio.project(position);
    await this.touchAt(studio.page, x, y);
  }

  private act(more: number): void {
    this.acts += 1;
    this.seconds += human.decide + human.point + human.click + more;
  }

  protected abstract touch(control: Locator): Promise<void>;
  protected abstract touchAt(page: Page, x: number, y: number): Promise<void>;
}

export class MouseHand extends PointingHand {
  protected touch(control: Locator): Promise<void> {
    return control.click();
  }

  protected touchAt(page: Page, x: number, y: number): Promise<void> {
    return page.mouse.click(x, y);
  }
}

export class FingerHand extends PointingHand {
  protected touch(control: Locator): Promise<void> {
    return control.tap();
  }

  protected touchAt(page: Page, x: number, y: number): Promise<void> {
    return page.touchscreen.tap(x, y);
  }
}

/** More stops of the Tab key on one way are a fault. */
const farthest = 60;
/** How near to the cross a place is near enough, in heights of the picture. */
const nearEnough = 0.008;
/** Of the studio, in heights of the picture: what one press of Shift and an arrow moves, and each repetition of a held one. */
const onePan = 0.01;
const heldPan = 0.04;
/** The part of the picture's height that a centimetre of the head has where a point is placed by keyboard; what a zoom leaves. */
const centimetre = 0.15;
const oneZoom = 0.9;

/** Tab, arrows, Enter and Space; no script gives the focus to anything. */
export class KeyboardHand implements Hand {
  acts = 0;
  keys = 0;
  seconds = 0;

  async press(control: Locator): Promise<void> {
    this.act(0);
    await this.goTo(control);
    await this.key(control.page(), 'Enter');
  }

  async placeAt(studio: StudioPage, position: Place): Promise<void> {
    const { page } = studio;
    this.act(human.read);
    await this.goTo(page.locator('canvas.canvas'));
    await this.bring(studio, position, false);
    // So near that the lips are apart.
    const { y } = await studio.project(position);
    const above = await studio.project([position[0], position[1] + 0.01, position[2]]);
    const box = (await page.locator('canvas.canvas').boundingBox())!;
    const zooms = Math.ceil(Math.log((centimetre * box.height) / (y - above.y)) / Math.log(1 / oneZoom));
    if (zooms > 0) await this.hold(page, '+', zooms);
    await this.bring(studio, position, true);
    await this.key(page, 'Space');
  }

  /** Moves the head until a place is under the cross, with held keys, and `exactly` with single ones too. */
  private async bring(studio: StudioPage, position: Place, exactly: boolean): Promise<void> {
    const { page } = studio;
    for (const axis of ['x', 'y'] as const) {
      const [back, on] = axis === 'x' ? ['ArrowLeft', 'ArrowRight'] : ['ArrowUp', 'ArrowDown'];
      // The hand sees where the place went: what is not in the plane of the picture's middle moves by more or by less.
      for (let tries = 0; ; tries += 1) {
        const far = await this.fromCross(studio, position, axis);
        const key = far < 0 ? back! : on!;
        const held = Math.round((Math.abs(far) - onePan) / heldPan);
        if (held > 0) await this.hold(page, key, held, 'Shift');
        else if (exactly && Math.abs(far) > nearEnough) await this.key(page, `Shift+${key}`);
        else break;
        if (tries > 16) throw new Error(`the place stays ${far} of the picture's height from the cross`);
      }
    }
  }

  private async key(page: Page, key: string): Promise<void> {
    this.keys += 1;
    this.seconds += human.key;
    await page.keyboard.press(key);
  }

  private async hold(page: Page, key: string, repetitions: number, modifier?: 'Shift'): Promise<void> {
    this.keys += 1;
    this.seconds += human.key + repeating.first + repetitions * repeating.next;
    if (modifier) await page.keyboard.down(modifier);
    for (let i = 0; i <= repetitions; i += 1) await page.keyboard.down(key);
    await page.keyboard.up(key);
    if (modifier) await page.keyboard.up(modifier);
  }

  private act(more: number): void {
    this.acts += 1;
    this.seconds += human.decide + more;
  }

  /** Where a place is drawn, from the cross in the middle of the picture, in heights of the picture. */
  private async fromCross(studio: StudioPage, position: Place, axis: 'x' | 'y'): Promise<number> {
    await studio.drawn(1);
    const at = await studio.project(position);
    const box = (await studio.page.locator('canvas.canvas').boundingBox())!;
    return axis === 'x' ? (at.x - box.x - box.width / 2) / box.height : (at.y - box.y - box.height / 2) / box.height;
  }

  /** By Tab to the control, or to its list and then by arrows, in the direction that a person sees. */
  private async goTo(control: Locator): Promise<void> {
    const page = control.page();
    for (let stops = 0; stops < farthest; stops += 1) {
      const way = await control.evaluate((target) => {
        const from = document.activeElement;
        if (from === target) return '';
        const group = target.closest('[role=tablist], [role=toolbar], ul, .viseme-grid');
        const isStop = (one: HTMLElement): boolean => one.tabIndex >= 0 && !one.matches(':disabled') && one.getClientRects().length > 0;
        if ((target as HTMLElement).tabIndex < 0 && group?.contains(from)) {
          const before = from!.compareDocumentPosition(target) & Node.DOCUMENT_POSITION_PRECEDING;
          return before ? 'ArrowLeft' : 'ArrowRight';
        }
        const stopsOfPage = [...document.querySelectorAll<HTMLElement>('a[href], button, input, select, textarea, summary, canvas, [tabindex]')].filter(isStop);
        const of = (one: Element | null): number => stopsOfPage.findIndex((stop) => stop === one);
        const to = of(target) >= 0 ? of(target) : stopsOfPage.findIndex((stop) => group?.contains(stop));
        return of(from) >= 0 && to < of(from) ? 'Shift+Tab' : 'Tab';
      });
      if (way === '') return;
      await this.key(page, way);
    }
    throw new Error(`no way by keyboard to ${String(control)}`);
  }
}

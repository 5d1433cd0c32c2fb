import { mkdirSync, readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { chromium as driver, type Browser, type BrowserContext, type BrowserContextOptions, type Page } from 'playwright-core';
import { writesPictures } from './looks.ts';
import { rest, takeRested, watchForRest } from './page_rest.ts';
import { buildDir, chromium } from './paths.ts';
import { eventually, patience, within } from './patience.ts';

/**
 * Features of Chromium that tests do without. It loads the popups of the address bar for each window, also of a headless browser: a
 * third of a short test's time; and it starts a renderer for the next site, which no test goes to. The others are those that
 * Playwright turns off, whose switch this one replaces.
 */
const withoutFeatures = [
  'WebUIOmniboxPopup',
  'WebUIOmniboxAimPopup',
  'SpareRendererForSitePerProcess',
  'AcceptCHFrame',
  'AvoidUnnecessaryBeforeUnloadCheckSync',
  'DestroyProfileOnBrowserClose',
  'DialMediaRouteProvider',
  'GlobalMediaControls',
  'HttpsUpgrades',
  'LensOverlay',
  'MediaRouter',
  'PaintHolding',
  'RenderDocument',
  'ThirdPartyStoragePartitioning',
  'Translate',
];

/** `args`: of Chromium, beside the usual ones. */
export function launch(args: string[] = []): Promise<Browser> {
  return driver.launch({
    executablePath: chromium,
    args: ['--no-sandbox', '--enable-unsafe-swiftshader', `--disable-features=${withoutFeatures.join()}`, ...args],
    timeout: patience,
  });
}

export interface OpenOptions {
  width?: number;
  height?: number;
  dark?: boolean;
  locale?: string;
  /** A touch screen. */
  touch?: boolean;
  motion?: BrowserContextOptions['reducedMotion'];
  /** A `lively` page with all its pixels, for tests of single pixels; the others have half of them along each side, see `coarse`. */
  sharp?: boolean;
  /**
   * Draws each frame, with as many pixels of the face as of the page, for tests of motion, frame rates and video. The others are calm:
   * they draw ten times a second at most, and a quarter of the pixels. A face that moves is drawn as often as the processor can.
   * `useStudio` states it for a whole file.
   */
  lively?: boolean;
  /**
   * Draws its head all the time; without it lively and sharp pages do. The others draw it while a test looks at it, see
   * `StudioPage.seen`: without a graphics card its first frame takes a third as much of the processor as the opening of a page, and a face
   * that moves takes more than all else on the page.
   */
  seen?: boolean;
  /** Console errors that the test expects; a refused request, for example, is logged as a failed one. */
  allowed?: RegExp;
}

/** Device pixels along a side of a CSS pixel, for tests that look at no single ones. */
export const coarse = 0.5;

/** What pages are that do not state it, in the present test file. */
export const usual: Required<Pick<OpenOptions, 'lively'>> = { lively: false };

/** How seldom a page with these options draws: see `OpenOptions`. */
function drawingOf(options: Pick<OpenOptions, 'lively' | 'seen' | 'sharp'>): { isCalm: boolean; isUnseen: boolean } {
  const isCalm = !(options.lively ?? usual.lively) && !options.sharp;
  return { isCalm, isUnseen: !(options.seen ?? !isCalm) };
}

/** Until `window.isSeen`, draws of WebGL 2 do nothing. Runs in the page. */
function drawUnseen(): void {
  const methods = WebGL2RenderingContext.prototype as unknown as Record<string, (...given: unknown[]) => void>;
  for (const name of ['drawElements', 'drawArrays', 'drawElementsInstanced', 'drawArraysInstanced', 'drawRangeElements']) {
    const draw = methods[name]!;
    methods[name] = function (this: WebGL2RenderingContext, ...given) {
      if ('isSeen' in window) draw.apply(this, given);
    };
  }
}

/** Pages of this context call WebGL 2 and draw nothing. For pages that are not the studio and whose pictures are not looked at. */
export const leaveOutDraws = (context: BrowserContext): Promise<void> => context.addInitScript(drawUnseen);

/** Pages of this context draw seldom and few pixels: see `OpenOptions.lively`. For pages that are not the studio. */
export function calmDown(context: BrowserContext): Promise<void> {
  return context.addInitScript(() => {
    Object.defineProperty(window, 'devicePixelRatio', { get: () => 0.25 }); // the layout keeps the pixels that it has
    const leastBetween = 90; // milliseconds: with the display's own steps ten frames a second
    const requestFrame = window.requestAnimationFrame.bind(window);
    let waiting = new Map<number, FrameRequestCallback>();
    let called = waiting;
    let last = -Infinity;
    let newest = 0;
    const tick = (time: number): void => {
      const early = leastBetween - (time - last);
      if (early > 0) {
        setTimeout(() => requestFrame(tick), early); // the browser prepares each frame that is asked for, also one that draws nothing
        return;
      }
      last = time;
      called = waiting;
      waiting = new Map();
      for (const callback of called.values()) {
        try {
          callback(time);
        } catch (error) {
          reportError(error); // as the browser does: the others are called all the same
        }
      }
    };
    window.requestAnimationFrame = (callback) => {
      if (waiting.size === 0) requestFrame(tick);
      waiting.set((newest += 1), callback);
      return newest;
    };
    window.cancelAnimationFrame = (id) => {
      waiting.delete(id);
      called.delete(id);
    };
  });
}

/** ms between two pictures that are equal when nothing moves: more than the studio waits before it draws a still picture with all pixels. */
const leastRest = 400;

/** A phone, for `StudioPage.open`. */
export const phone = { width: 390, height: 844, touch: true } as const;

/** A page of the studio that records all errors of its console and scripts. */
export class StudioPage {
  readonly errors: string[] = [];
  private readonly size: { width: number; height: number };
  private isClosed = false;

  private constructor(
    readonly context: BrowserContext,
    readonly page: Page,
    private readonly isUnseen: boolean,
    private readonly kind?: string,
  ) {
    this.size = page.viewportSize()!;
  }

  static async open(browser: Browser, url: string, options: OpenOptions = {}): Promise<StudioPage> {
    const given: BrowserContextOptions = {
      viewport: { width: options.width ?? 880, height: options.height ?? 560 },
      colorScheme: options.dark ? 'dark' : 'light',
      reducedMotion: options.motion ?? 'reduce',
      deviceScaleFactor: options.sharp ? 1 : coarse,
      serviceWorkers: 'block', // it loads the whole studio a second time, and keeps it: see offline.test.ts
      ...(options.locale ? { locale: options.locale } : {}),
      ...(options.touch ? { isMobile: true, hasTouch: true } : {}),
    };
    const kind = JSON.stringify([given, drawingOf(options)]);
    const rested = takeRested(browser, kind);
    if (rested) return StudioPage.show(rested, url, options, kind);
    return StudioPage.openIn(await browser.newContext(given), url, options, kind);
  }

  /** In a context of the test's own, which has no page yet. `kind`: of pages that may rest after the test. */
  static async openIn(context: BrowserContext, url: string, options: Pick<OpenOptions, 'allowed' | 'lively' | 'seen' | 'sharp'> = {}, kind?: string): Promise<StudioPage> {
    context.setDefaultTimeout(patience);
    const { isCalm, isUnseen } = drawingOf(options);
    if (isCalm) await calmDown(context);
    if (isUnseen) await leaveOutDraws(context);
    const page = await context.newPage();
    // Playwright's timeout is not for scripts: one that waits in the page for what never comes would wait without end.
    const evaluate = page.evaluate.bind(page) as (script: unknown, argument?: unknown) => Promise<unknown>;
    page.evaluate = ((script: unknown, argument?: unknown) => within(`a script in the page: ${String(script).slice(0, 200)}`, evaluate(script, argument))) as Page['evaluate'];
    // By time: at each frame of the display, Playwright's usual way, the browser would prepare 60 frames a second.
    const waitForFunction = page.waitForFunction.bind(page) as (script: unknown, argument?: unknown, options?: object) => Promise<unknown>;
    page.waitForFunction = ((script: unknown, argument?: unknown, given?: object) => waitForFunction(script, argument, { polling: 50, ...given })) as Page['waitForFunction'];
    if (kind !== undefined) await watchForRest(page);
    return StudioPage.show(page, url, options, kind);
  }

  private static async show(page: Page, url: string, options: Pick<OpenOptions, 'allowed' | 'lively' | 'seen' | 'sharp'>, kind?: string): Promise<StudioPage> {
    const studio = new StudioPage(page.context(), page, drawingOf(options).isUnseen, kind);
    const report = (fault: string): void => {
      if (!options.allowed?.test(fault)) studio.errors.push(fault);
    };
    page.on('console', (message) => {
      const { url: at } = message.location();
      if (at.endsWith('/favicon.ico')) return; // which Chromium asks for of a page at rest, a picture that links no icon
      // The words of a refused request do not say which one it was.
      if (message.type() === 'error' || message.text().includes('Context Lost')) report(`${message.text()} (${at})`);
    });
    page.on('pageerror', (error) => studio.errors.push(String(error)));
    page.on('requestfailed', (request) => {
      // Requests that the page itself aborted (a newer one replaced them) are not faults.
      if (request.failure()?.errorText !== 'net::ERR_ABORTED')
        report(`${request.url()}: ${request.failure()?.errorText ?? ''}`);
    });
    await page.goto(url, { waitUntil: 'domcontentloaded', timeout: patience });
    return studio;
  }

  /** Waits until the scene has this state. */
  async waitForStage(kind: 'ready' | 'failed'): Promise<void> {
    await this.page.waitForFunction(
      (wanted) => (window as unknown as Inside).semblante?.scene.state.value.kind === wanted,
      kind,
    );
  }

  async waitForState(state: string): Promise<void> {
    await this.page.waitForFunction(
      (wanted) => (window as unknown as Inside).semblante?.studio.selected.value?.state === wanted,
      state,
    );
  }

  /** Waits for this number of frames, of which a calm page has ten a second. */
  async drawn(times: number): Promise<void> {
    await this.page.evaluate(
      (count) =>
        new Promise<void>((done) => {
          let left = count;
          const next = (): void => {
            left -= 1;
            if (left < 0) done();
            else requestAnimationFrame(next);
          };
          next();
        }),
      times,
    );
  }

  /** Drops a file on the page, as from a file manager. */
  drop(path: string, name = basename(path)): Promise<void> {
    return this.dropBytes(name, readFileSync(path));
  }

  dropText(name: string, text: string): Promise<void> {
    return this.dropBytes(name, Buffer.from(text));
  }

  private async dropBytes(name: string, bytes: Buffer): Promise<void> {
    const transfer = await this.page.evaluateHandle(
      async ({ content, fileName }) => {
        const bytes = Uint8Array.from(atob(content), (c) => c.charCodeAt(0));
        const data = new DataTransfer();
        data.items.add(new File([bytes], fileName));
        return data;
      },
      { content: bytes.toString('base64'), fileName: name },
    );
    for (const type of ['dragenter', 'dragover', 'drop'])
      await this.page.dispatchEvent('.studio', type, { dataTransfer: transfer });
  }

  /** Drops a file or folder of the disk on the page. Unlike `drop`, the browser itself reads it: a folder stays a folder. */
  async dropReal(path: string): Promise<void> {
    const devtools = await this.page.context().newCDPSession(this.page);
    const data = { items: [], files: [path], dragOperationsMask: 1 };
    await this.page.evaluate(() => addEventListener('drop', () => Object.assign(window, { hasDropped: true }), { capture: true, once: true }));
    const hasDropped = (): Promise<boolean> =>
      this.page.waitForFunction(() => 'hasDropped' in window, undefined, { timeout: 10_000 }).then(() => true, () => false);
    // A busy browser may take the drop for a leave, when the page has not yet said that it takes files.
    await eventually('the page gets what is dropped', async () => {
      for (const type of ['dragEnter', 'dragOver', 'drop'] as const) await devtools.send('Input.dispatchDragEvent', { type, x: 700, y: 400, data });
      return hasDropped();
    });
    await this.page.evaluate(() => void Reflect.deleteProperty(window, 'hasDropped'));
    await devtools.detach();
  }

  /** What `work` gives while the page draws all that it shows: whatever looks at the pixels of its canvas does so in here. */
  async seen<T>(work: () => Promise<T>): Promise<T> {
    if (!this.isUnseen) return work();
    await this.page.evaluate(async () => {
      Object.assign(window, { isSeen: true });
      const scene = (window as unknown as Partial<Inside>).semblante?.scene; // the sign-in has none
      const stages = [scene, scene?.twin].flatMap((one) => (one ? [one.stage] : []));
      const drawn = stages.map((stage) => stage.drawn);
      for (const stage of stages) stage.invalidate();
      while (stages.some((stage, i) => stage.drawn === drawn[i])) await new Promise(requestAnimationFrame);
    });
    try {
      return await work();
    } finally {
      await this.page.evaluate(() => void Reflect.deleteProperty(window, 'isSeen'));
    }
  }

  /** The picture of the stage only, without the messages over it, which come and go. */
  async picture(): Promise<Buffer> {
    const show = (visibility: string): Promise<void> =>
      this.page.evaluate((value) => document.querySelector<HTMLElement>('.toasts')?.style.setProperty('visibility', value), visibility);
    await show('hidden');
    const picture = await this.seen(() => this.page.locator('canvas.canvas').screenshot());
    await show('visible');
    return picture;
  }

  /** The picture of the stage after it has stopped changing. */
  async pictureAtRest(): Promise<Buffer> {
    let last = await this.picture();
    await eventually(
      'the stage comes to rest',
      async () => {
        // Frames, as a busy machine has few; and time, in which a face and a camera that are on their way move by what is seen.
        await Promise.all([this.drawn(4), this.page.waitForTimeout(leastRest)]);
        const before = last;
        last = await this.picture();
        return last.equals(before);
      },
      0,
    );
    return last;
  }

  /** Waits until the stage differs from an earlier picture by more than a threshold in a region, in squares of 8 pixels; see difference(). */
  async pictureUnlike(
    before: Buffer,
    region: readonly [number, number, number, number],
    least: number,
  ): Promise<Buffer> {
    let picture = before;
    let difference = 0;
    try {
      await eventually(`the picture changes by more than ${least}`, async () => {
        // Whoever waits for a page with an error would wait until the end.
        if (this.errors.length > 0) throw new Error(`the page reports: ${this.errors.join('; ')}`);
        picture = await this.picture();
        difference = await this.difference(before, picture, region, 8);
        return difference > least;
      });
    } catch (error) {
      throw new Error(`${String(error)} (last difference ${difference}; ${await this.motion()})`);
    }
    return picture;
  }

  /** What moves the face and how far it is, as JSON, for the message of a test that fails. */
  private motion(): Promise<string> {
    return this.page.evaluate(async () => {
      const { driver, scene } = (window as unknown as Inside).semblante;
      const frames = new Promise<boolean>((answer) => requestAnimationFrame(() => answer(true)));
      const noFrames = new Promise<boolean>((answer) => setTimeout(() => answer(false), 10_000));
      const player = scene.performer.value?.player;
      const { face, stage, state } = scene;
      return JSON.stringify({
        source: driver.source.value,
        stage: state.value.kind,
        visible: face?.object.visible,
        page: document.visibilityState,
        frames: await Promise.race([frames, noFrames]),
        drawnPerSecond: stage.framesPerSecond,
        playhead: player?.playhead,
        delay: player?.delay,
        playout: player?.stats,
      });
    });
  }

  /**
   * Mean difference of two pictures, 0..255, within a region (x, y, width, height as fractions of the picture), of the mean
   * colours of squares of `square` pixels. A picture that moves may have fewer pixels than a still one; squares of 8 do not see that.
   */
  async difference(a: Buffer, b: Buffer, region: readonly [number, number, number, number], square = 1): Promise<number> {
    return this.page.evaluate(
      async ({ first, second, region: [x, y, w, h], square }) => {
        const pixels = async (base64: string): Promise<ImageData> => {
          const image = await createImageBitmap(
            new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: 'image/png' }),
          );
          const canvas = new OffscreenCanvas(image.width, image.height);
          const context = canvas.getContext('2d')!;
          context.drawImage(image, 0, 0);
          return context.getImageData(image.width * x, image.height * y, image.width * w, image.height * h);
        };
        const [one, two] = [await pixels(first), await pixels(second)];
        if (one.width !== two.width || one.height !== two.height)
          throw new Error(`pictures of ${one.width} by ${one.height} and ${two.width} by ${two.height} pixels`);
        const across = Math.ceil(one.width / square);
        const sums = new Float64Array(across * Math.ceil(one.height / square) * 3);
        for (let i = 0; i < one.data.length; i += 4) {
          const pixel = i / 4;
          const at = 3 * (Math.floor(Math.floor(pixel / one.width) / square) * across + Math.floor((pixel % one.width) / square));
          for (let k = 0; k < 3; k += 1) sums[at + k]! += one.data[i + k]! - two.data[i + k]!;
        }
        return sums.reduce((sum, value) => sum + Math.abs(value), 0) / ((one.data.length / 4) * 3);
      },
      { first: a.toString('base64'), second: b.toString('base64'), region, square },
    );
  }

  /** Projects a position in model space to page coordinates, pixels. */
  async project(position: readonly number[]): Promise<{ x: number; y: number }> {
    return this.page.evaluate((at) => {
      const { scene } = (window as unknown as Inside).semblante;
      const canvas = document.querySelector('canvas.canvas')!.getBoundingClientRect();
      const place = scene.markers.project(at, scene.stage.camera, canvas.width, canvas.height);
      return { x: canvas.left + place.x, y: canvas.top + place.y };
    }, position);
  }

  /** Saves a screenshot of the whole page for inspection by people, if they asked for it. */
  async keep(name: string): Promise<void> {
    if (!writesPictures) return;
    const folder = join(buildDir, 'screenshots');
    mkdirSync(folder, { recursive: true });
    await this.seen(() => this.page.screenshot({ path: join(folder, `${name}.png`) }));
  }

  /** Ends the test's use of the page, which rests for another test if it can. */
  async close(): Promise<void> {
    if (this.isClosed) return;
    this.isClosed = true; // the page may be another test's by now
    if (this.kind === undefined || !(await rest(this.page, this.kind, this.size))) await this.context.close();
  }
}

/** The part of `window.semblante` that the tests use. */
export interface Inside {
  semblante: {
    scene: {
      state: { value: { kind: string } };
      markers: {
        project(position: readonly number[], camera: unknown, width: number, height: number): { x: number; y: number };
      };
      stage: { camera: { position: { toArray(): number[] } }; framesPerSecond: number; drawn: number; invalidate(): void };
      twin: { stage: Inside['semblante']['scene']['stage'] } | null;
      face: {
        mesh: { vertexCount: number; rowOffsets: Uint32Array; rowWeights: Float32Array };
        object: { visible: boolean };
      } | null;
      rig: { feature_points: { id: string; vertex: number | null }[] } | null;
      performer: {
        value: {
          poseNumber: number;
          kernel: { deform(pose: number): void; positions: Float32Array };
          player: { playhead: number; delay: number; stats: object };
        } | null;
      };
      highlight: {
        parts: { children: { geometry: { index: { count: number } | null } }[] };
        dots: { count: number; object: { visible: boolean } };
      };
    };
    driver: { source: { value: string }; byHand(): void };
    studio: { selected: { value: { id: string; state: string } | null } };
    live: { following: { value: string | null }; streams: { value: { id: string; sequence: number }[] | null }; stats: { dropped: number } };
  };
}

import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer as createHttpServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname, join } from 'node:path';
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { moves, project, server, unpacked, usePackedPackage } from './support/packed_package.ts';
import { buildDir } from './support/paths.ts';
import { patience } from './support/patience.ts';
import { browser } from './support/suite.ts';
import { everyVariant } from './support/variants.ts';

usePackedPackage();

test('Package_BarePage_ShowsAMovingFace', async () => {
  const example = join(unpacked, 'example.html');
  const page = readFileSync(example, 'utf8');
  expect(page.split('\n').length).toBeLessThanOrEqual(10);
  expect(page).toContain('http://127.0.0.1:8080');
  writeFileSync(example, page.replace('http://127.0.0.1:8080', server.url));
  await moves('/node_modules/semblante/example.html');
});

test('Package_ElementOfAFramework_TakesWhatWasSetBeforeItIsDefined_AndWhatIsTakenAway', async () => {
  const early = "{ src: '', stream: 'demo', alt: 'Ana', model: 'sample', token: null, captions: true }";
  writeFileSync(join(project, 'early.js'), `Object.assign(document.querySelector('semblante-face'), ${early});`);
  writeFileSync(
    join(project, 'early.html'),
    `<!doctype html><semblante-face></semblante-face><script src="early.js"></script>
<script type="module" src="node_modules/semblante/dist/element.js"></script>`,
  );
  await moves('/early.html', server.url, async (page) => {
    const attributes = (): Promise<Record<string, string>> =>
      page.evaluate(() => {
        const face = document.querySelector('semblante-face')!;
        return Object.fromEntries(face.getAttributeNames().map((name) => [name, face.getAttribute(name)!]));
      });
    expect(await attributes()).toEqual({ src: '', stream: 'demo', alt: 'Ana', model: 'sample', captions: '' });
    expect(await page.getByRole('img', { name: 'Ana' }).count()).toBe(1);
    await page.evaluate(() => {
      const gone = { alt: null, model: undefined, poster: null, fit: undefined, quality: null, theme: undefined, captions: undefined };
      Object.assign(document.querySelector('semblante-face')!, gone);
    });
    expect(await attributes()).toEqual({ src: '', stream: 'demo' });
    await page.waitForFunction(() => (document.querySelector('semblante-face') as { state?: string } | null)?.state === 'playing');
  });
});

/** React 18 writes `sound="false"` for `sound={false}`. */
test('Package_ElementWithTheWordFalse_IsOffAndAsWithoutTheAttribute', async () => {
  writeFileSync(
    join(project, 'false.html'),
    `<!doctype html><semblante-face stream="demo" sound="false" voice="false" captions="false"></semblante-face>
<script type="module" src="node_modules/semblante/dist/element.js"></script>`,
  );
  type Switches = HTMLElement & { sound: boolean; voice: boolean; captions: boolean };
  await moves('/false.html', server.url, async (page) => {
    const switches = (): Promise<boolean[]> =>
      page.evaluate(() => {
        const { sound, voice, captions } = document.querySelector('semblante-face') as Switches;
        return [sound, voice, captions];
      });
    const button = page.getByRole('button', { name: /^(Sound|Voice)/ });
    expect(await switches()).toEqual([false, false, false]);
    expect(await button.count()).toBe(0);
    await page.evaluate(() => document.querySelector('semblante-face')!.setAttribute('sound', 'true'));
    expect(await switches()).toEqual([true, false, false]);
    await button.waitFor(); // the server has a voice
  });
});

test('Package_ElementWhoseSoundVoiceOrTokenChanges_KeepsItsFace', async () => {
  writeFileSync(
    join(project, 'switch.html'),
    `<!doctype html><semblante-face stream="demo"></semblante-face>
<script type="module" src="node_modules/semblante/dist/element.js"></script>`,
  );
  type Switched = HTMLElement & { sound: boolean; voice: boolean; token: string; state: string; canvas: Element | null; states: string[] };
  await moves('/switch.html', server.url, async (page) => {
    const parts: string[] = [];
    const tokens: (string | undefined)[] = [];
    const hellos: Buffer[] = [];
    page.on('request', (request) => {
      if (/\/(mesh\.drc|weights|rig\.json)/.test(request.url())) parts.push(request.url());
      if (request.url().endsWith('/v1/streams/demo')) tokens.push(request.headers()['authorization']);
    });
    page.on('websocket', (socket) => {
      let isFirst = true;
      socket.on('framesent', ({ payload }) => {
        if (isFirst) hellos.push(Buffer.from(payload));
        isFirst = false;
      });
    });
    await page.evaluate(() => {
      const face = document.querySelector<Switched>('semblante-face')!;
      face.canvas = face.shadowRoot!.querySelector('canvas');
      face.states = [];
      face.addEventListener('statechange', (event) => face.states.push((event as CustomEvent<{ state: string }>).detail.state));
    });
    const put = (change: { sound?: boolean; voice?: boolean; token?: string }): Promise<void> =>
      page.evaluate((change) => void Object.assign(document.querySelector<Switched>('semblante-face')!, change), change);
    const connected = async (count: number): Promise<void> => expect.poll(() => hellos.length, { timeout: patience }).toBe(count);

    await put({ voice: true });
    await put({ voice: false });
    await put({ sound: true });
    await connected(1); // the voice needs no connection
    await page.getByRole('button', { name: 'Sound on' }).click();
    await page.getByRole('button', { name: 'Sound off' }).waitFor();
    await put({ token: 'abc' });
    await connected(2);
    await page.getByRole('button', { name: 'Sound off' }).waitFor(); // still heard
    await put({ token: 'abc' }); // no change
    await put({ sound: false });
    await connected(3);
    await expect.poll(() => page.getByRole('button', { name: /^Sound/ }).count(), { timeout: patience }).toBe(0);
    expect(tokens).toEqual(['Bearer abc']);
    expect(hellos[0]).toEqual(hellos[1]);
    expect(hellos[2]).not.toEqual(hellos[1]);
    expect(parts).toEqual([]);
    await page.evaluate(async () => {
      const face = document.querySelector<Switched>('semblante-face')!;
      if (face.shadowRoot!.querySelector('canvas') !== face.canvas) throw new Error('another picture');
      if (face.states.some((state) => state !== 'playing')) throw new Error(face.states.join());
      const poses = (): string => Array.from((face as unknown as { show: { kernel: { poses: { featurePoints: Float32Array }[] } } }).show.kernel.poses[0]!.featurePoints).join();
      for (const before = poses(); poses() === before; ) await new Promise(requestAnimationFrame); // it moves
    });
  });
});

/** As a framework does with a list that is sorted. */
test('Package_ElementMovedWithinItsPage_GoesOn_AndOneTakenOffEnds', async () => {
  writeFileSync(
    join(project, 'sort.html'),
    `<!doctype html><main></main><semblante-face stream="demo"></semblante-face>
<script type="module" src="node_modules/semblante/dist/element.js"></script>`,
  );
  await moves('/sort.html', server.url, async (page) => {
    const next = page.waitForEvent('websocket', { timeout: patience });
    await page.evaluate(async () => {
      const face = document.querySelector('semblante-face')!;
      const canvas = face.shadowRoot!.querySelector('canvas');
      document.querySelector('main')!.append(face);
      await new Promise((done) => requestAnimationFrame(done));
      if ((face as unknown as { state: string }).state !== 'playing' || face.shadowRoot!.querySelector('canvas') !== canvas) throw new Error('began again');
      face.remove();
      await new Promise((done) => requestAnimationFrame(done));
      if ((face as unknown as { state: string }).state !== 'idle') throw new Error('goes on');
      document.body.append(face);
    });
    await next; // the first since the page moved
    await page.waitForFunction(() => (document.querySelector('semblante-face') as { state?: string } | null)?.state === 'playing');
  });
});

/** As with a picture in picture: the pictures of a page that is hidden do not go on, those of the other window do. */
test('Package_ElementMovedToAnotherWindow_IsDrawnThereAsBefore', async () => {
  writeFileSync(
    join(project, 'move.html'),
    `<!doctype html><iframe width="400" height="500"></iframe><semblante-face stream="demo" captions></semblante-face>
<script type="module" src="node_modules/semblante/dist/element.js"></script>`,
  );
  await moves('/move.html', server.url, async (page) => {
    await page.evaluate(() => {
      const face = document.querySelector('semblante-face')!;
      document.implementation.createHTMLDocument().body.append(face); // no window shows it
      window.requestAnimationFrame = () => 0;
      document.querySelector('iframe')!.contentDocument!.body.append(face);
    });
    const face = page.frameLocator('iframe').locator('semblante-face');
    await expect.poll(() => face.evaluate((one) => (one as unknown as { state: string }).state), { timeout: patience }).toBe('playing');
    const shown = await face.evaluate((one) => {
      const { width, height } = one.getBoundingClientRect();
      return { width, height, sheets: one.shadowRoot!.adoptedStyleSheets.length };
    });
    expect(shown).toEqual({ width: 320, height: 400, sheets: 2 });
  });
});

/** Of a region of the page, from two pictures of it: the share of pixels that the face covers, and of those that changed. */
interface Seen {
  covered: number;
  changed: number;
}

/** What two pictures of a page show at these places: what the first covers, and what the second changes. */
async function compare(page: Page, places: { x: number; y: number; width: number; height: number }[], pictures: Buffer[]): Promise<Seen[]> {
  const addresses = pictures.map((picture) => `data:image/png;base64,${picture.toString('base64')}`);
  return page.evaluate(
    async ([regions, sources]) => {
      const [first, second] = await Promise.all(
        sources.map(async (source) => {
          const image = new Image();
          image.src = source;
          await image.decode();
          const canvas = new OffscreenCanvas(image.width, image.height);
          const context = canvas.getContext('2d')!;
          context.drawImage(image, 0, 0);
          return context;
        }),
      );
      return regions.map(({ x, y, width, height }) => {
        const [before, after] = [first!, second!].map((context) => context.getImageData(x, y, width, height).data);
        let covered = 0;
        let changed = 0;
        for (let i = 0; i < before!.length; i += 4) {
          const differs = (a: ArrayLike<number>, from: number, b: ArrayLike<number>): boolean =>
            [0, 1, 2].some((channel) => Math.abs(a[from + channel]! - b[i + channel]!) > 12);
          if (differs(before!, 0, before!)) covered += 1; // the first pixel is a corner: background
          if (differs(before!, i, after!)) changed += 1;
        }
        return { covered: covered / (width * height), changed: changed / (width * height) };
      });
    },
    [places, addresses] as const,
  );
}

type Faces = NodeListOf<HTMLElement & { state: string }>;

/** A browser gives a page 16 contexts of WebGL. Without a graphics card each face costs as much as the whole studio. */
test.runIf(everyVariant)('Package_ManyFaces_AreAllDrawnAndMove_AlsoAfterTheirContextsAreLost_AndWhenTheyAreSeenAgain', async () => {
  const count = 24;
  // All contexts of the page with the number of their textures, and the faces that say that they are not drawn.
  writeFileSync(
    join(project, 'contexts.js'),
    `const { getContext } = HTMLCanvasElement.prototype;
window.contexts = new Set();
window.lost = new Set();
window.textures = 0;
const { createTexture, deleteTexture } = WebGL2RenderingContext.prototype;
WebGL2RenderingContext.prototype.createTexture = function () {
  textures += 1;
  return createTexture.call(this);
};
WebGL2RenderingContext.prototype.deleteTexture = function (texture) {
  if (texture) textures -= 1;
  deleteTexture.call(this, texture);
};
HTMLCanvasElement.prototype.getContext = function (kind, ...options) {
  const context = getContext.call(this, kind, ...options);
  if (kind === 'webgl2') contexts.add(context);
  return context;
};
document.addEventListener('statechange', ({ target, detail }) => detail.state === 'loading' && lost.add(target), true);`,
  );
  writeFileSync(join(project, 'many.css'), 'body { margin: 0; display: flex; flex-wrap: wrap } semblante-face { width: 100px; height: 120px }');
  writeFileSync(
    join(project, 'many.html'),
    `<!doctype html><link rel="stylesheet" href="many.css"><script src="contexts.js"></script><body>${'<semblante-face stream="demo"></semblante-face>'.repeat(count)}
<script type="module" src="node_modules/semblante/dist/element.js"></script>`,
  );
  await moves('/many.html', server.url, async (page) => {
    const places = await page.evaluate(() =>
      [...document.querySelectorAll('semblante-face')].map((face) => {
        const { x, y, width, height } = face.getBoundingClientRect();
        return { x, y, width, height };
      }),
    );
    const picture = (): Promise<Buffer> => page.screenshot({ timeout: patience });
    /** A face that speaks changes at least at its mouth: until every one has, and none is blank. */
    const allMove = async (): Promise<void> => {
      await page.waitForFunction(() => [...(document.querySelectorAll('semblante-face') as Faces)].every(({ state }) => state === 'playing'));
      let last = await picture(); // a face may still fade in
      const moved = new Set<number>();
      await expect
        .poll(
          async () => {
            const next = await picture();
            const seen = await compare(page, places, [last, next]);
            last = next;
            seen.forEach(({ covered, changed }, i) => {
              if (covered > 0.25 && changed > 0.002) moved.add(i);
            });
            const states = await page.evaluate(() => [...(document.querySelectorAll('semblante-face') as Faces)].map(({ state }) => state));
            return seen.flatMap(({ covered, changed }, i) => (moved.has(i) ? [] : [`face ${i}, ${states[i]}: ${covered} covered, ${changed} changed`]));
          },
          { timeout: patience, interval: 500 },
        )
        .toEqual([]);
    };
    await allMove();
    const textures = (): Promise<number> => page.evaluate(() => (window as unknown as { textures: number }).textures);
    const scroll = (margin: string): Promise<void> => page.evaluate((top) => void (document.body.style.marginTop = top), margin);
    const before = await textures();
    await scroll('5000px');
    await expect.poll(textures, { timeout: patience }).toBeLessThan(before - count);
    await scroll('0');
    await allMove();
    // Some come back, as after a reset of the graphics card; others do not, as when the page has too many.
    await page.evaluate(() => {
      const { contexts, lost } = window as unknown as { contexts: Set<WebGL2RenderingContext>; lost: Set<EventTarget> };
      lost.clear();
      [...contexts]
        .map((context) => context.getExtension('WEBGL_lose_context'))
        .filter((extension) => extension !== null)
        .forEach((extension, i) => {
          extension.loseContext();
          if (i % 2 === 0) setTimeout(() => extension.restoreContext(), 100);
        });
    });
    await page.waitForFunction((faces) => (window as unknown as { lost: Set<EventTarget> }).lost.size === faces, count);
    await allMove();
    const pictures = join(buildDir, 'screenshots');
    mkdirSync(pictures, { recursive: true });
    writeFileSync(join(pictures, 'many_faces.png'), await picture());
  });
});

/** A stranger's server of the project: its pages have no Content-Security-Policy, as those of `server` have. */
async function stranger(): Promise<{ url: string; stop: () => Promise<void> }> {
  const types: Record<string, string> = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm' };
  const pages = createHttpServer(({ url }, answer) => {
    const file = join(project, new URL(url!, 'http://localhost').pathname);
    const type = types[extname(file)];
    if (type === undefined || !existsSync(file)) return void answer.writeHead(404).end();
    answer.writeHead(200, { 'Content-Type': type }).end(readFileSync(file));
  });
  await new Promise<void>((listening) => pages.listen(0, '127.0.0.1', listening));
  return { url: `http://127.0.0.1:${(pages.address() as AddressInfo).port}`, stop: () => new Promise((stopped) => void pages.close(() => stopped())) };
}

test('Package_PageOfAnotherOrigin_SaysInTheConsoleHowItIsAllowed', async () => {
  const face = `<semblante-face src="${server.url}" stream="demo"></semblante-face>`;
  writeFileSync(join(project, 'foreign.html'), `<!doctype html>${face}<script type="module" src="node_modules/semblante/dist/element.js"></script>`);
  const other = await stranger();
  const page = await browser.newPage();
  try {
    const isHint = (text: string): boolean => text.endsWith(`semblante serve --allow-origin ${other.url}`);
    const hint = page.waitForEvent('console', { predicate: (message) => isHint(message.text()), timeout: patience });
    await page.goto(`${other.url}/foreign.html`, { timeout: patience });
    expect((await hint).type()).toBe('warning');
  } finally {
    await page.close();
    await other.stop();
  }
});

test('Package_ServerThatThePagesPolicyForbids_IsToldFromOneThatDoesNotAnswer', async () => {
  writeFileSync(join(project, 'trouble.js'), "document.querySelector('semblante-face').addEventListener('error', ({ detail }) => (globalThis.code ??= detail.code));");
  const pageOf = (src: string, policy: string): string =>
    `<!doctype html>${policy && `<meta http-equiv="Content-Security-Policy" content="connect-src ${policy}">`}<semblante-face src="${src}" stream="demo"></semblante-face>
<script src="trouble.js"></script><script type="module" src="node_modules/semblante/dist/element.js"></script>`;
  const other = await stranger();
  const page = await browser.newPage();
  const codeOn = async (src: string, policy: string): Promise<unknown> => {
    writeFileSync(join(project, 'trouble.html'), pageOf(src, policy));
    await page.goto(`${other.url}/trouble.html`, { timeout: patience });
    return (await page.waitForFunction(() => (globalThis as { code?: string }).code, undefined, { timeout: patience })).jsonValue();
  };
  try {
    expect(await codeOn(server.url, "'self'")).toBe('policy');
    expect(await codeOn(server.url, '')).toBe('unreachable'); // it refuses this origin
    expect(await codeOn(other.url, server.url)).toBe('policy');
  } finally {
    await page.close();
    await other.stop();
  }
});

test('Package_Greeting_IsSaidInBothLanguages', async () => {
  const greeting = join(unpacked, 'greeting.html');
  writeFileSync(greeting, readFileSync(greeting, 'utf8').replace('http://127.0.0.1:8080', server.url));
  const playing = async (): Promise<string | undefined> => {
    const stream = (await (await fetch(`${server.url}/v1/streams/demo`)).json()) as { playing: { id: string } | null };
    return stream.playing?.id;
  };
  await moves('/node_modules/semblante/greeting.html', server.url, async (page) => {
    const said = new Set([await playing(), undefined]);
    for (const name of ['Hello!', 'Olá!']) {
      await page.getByRole('button', { name }).click();
      let now: string | undefined;
      await expect.poll(async () => said.has((now = await playing())), { timeout: patience }).toBe(false);
      said.add(now);
      expect(await page.getByRole('status').textContent()).toBe('');
    }
  });
});

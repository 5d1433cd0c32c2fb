import { join } from 'node:path';
import { expect, test } from 'vitest';
import { bytesOf, growthOf, heldByScripts, type Holdings } from './support/heap.ts';
import { root, sampleHead } from './support/paths.ts';
import { coarse, StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

/** How long the studio is used; without it, the few rounds that show what grows with each of them. */
const seconds = Number(process.env['SEMBLANTE_SOAK_SECONDS'] ?? 0);
const fewRounds = 2;
/** First rounds, which fill caches: compiled shaders, texts, the tabs' code. */
const warmUp = 2;

/** What a page holds after the collector has run. */
interface Held {
  /** Of WebGL: buffers, textures, framebuffers, programs and the like. */
  gpu: Record<string, number>;
  nodes: number;
  listeners: number;
  scripts: Holdings;
}

/** Nodes that may be more, whatever the number of rounds: the longer text of a line that tells figures. */
const nodesOfTheMoment = 20;
/** Bytes of scripts that may be more, whatever the number of rounds: a list that is being asked for, a text that is being shown. */
const bytesOfTheMoment = 60_000;
/** A head of the sample's size has 900 kB, its smallest part, the numbers of its poses, 5 kB. */
const bytesOfARound = 2_000;

/**
 * The heap of WebAssembly never shrinks. On a slow page it grows once more, when two heads are loaded at the same time.
 * What is never freed grows in every stretch of rounds.
 */
const stretches = 3;

/** What a page holds more after some rounds than the moment explains; empty: nothing. */
function whatGrew(before: Held, after: Held, rounds: number): string[] {
  const grown = Object.keys(after.gpu).filter((kind) => after.gpu[kind]! > before.gpu[kind]!);
  const bytes = bytesOf(after.scripts) - bytesOf(before.scripts);
  if (bytes >= bytesOfTheMoment + rounds * bytesOfARound) grown.push(`${bytes} bytes: ${growthOf(before.scripts, after.scripts)}`);
  if (after.nodes - before.nodes >= nodesOfTheMoment) grown.push(`${after.nodes - before.nodes} nodes`);
  if (after.listeners > before.listeners) grown.push(`${after.listeners - before.listeners} listeners`);
  return grown;
}

/** Counts the objects of WebGL that a page has made and not deleted. Runs in the page, before its scripts. */
function countGpuObjects(): void {
  const live: Record<string, number> = {};
  (window as unknown as { gpuObjects: Record<string, number> }).gpuObjects = live;
  const prototype = WebGL2RenderingContext.prototype as unknown as Record<string, (...given: unknown[]) => unknown>;
  for (const kind of ['Buffer', 'Texture', 'Framebuffer', 'Renderbuffer', 'Program', 'Shader', 'VertexArray']) {
    live[kind] = 0;
    const make = prototype[`create${kind}`]!;
    const remove = prototype[`delete${kind}`]!;
    prototype[`create${kind}`] = function (...given) {
      live[kind]! += 1;
      return make.apply(this, given);
    };
    prototype[`delete${kind}`] = function (...given) {
      if (given[0]) live[kind]! -= 1;
      return remove.apply(this, given);
    };
  }
}

useStudio();

test('Studio_Used_HoldsNoMoreAfterEachRound', async () => {
  const context = await browser.newContext({ viewport: { width: 880, height: 560 }, deviceScaleFactor: coarse, reducedMotion: 'reduce', serviceWorkers: 'block' });
  await context.addInitScript(countGpuObjects);
  const studio = await StudioPage.openIn(context, server.url);
  const { page } = studio;
  const devtools = await context.newCDPSession(page);
  await studio.waitForStage('ready');

  /** Waits until a head is on the stage; gives its name. */
  const onStage = async (isSample: boolean): Promise<string> => {
    const selected = await page.waitForFunction((wanted) => {
      const { studio: { selected }, scene } = (window as unknown as Inside).semblante;
      const model = selected.value;
      const there = model !== null && (model.id === 'sample') === wanted && model.state !== 'importing' && scene.state.value.kind === 'ready';
      return there ? model.id : null;
    }, isSample);
    return (await selected.jsonValue())!;
  };
  const look = async (...tabs: string[]): Promise<void> => {
    for (const tab of tabs) {
      await page.locator(`#tab-${tab}`).click();
      await studio.drawn(3);
    }
  };

  /** Another head comes and goes, each tab is looked at, a file is played, a slider is moved, the stream is left and followed again. */
  const round = async (): Promise<void> => {
    await studio.drop(sampleHead, 'soak.glb');
    const other = await onStage(false);
    await look('points', 'fit', 'animate');
    await page.evaluate(() => (location.hash = '#sample/animate'));
    await onStage(true);
    await look('points', 'fit', 'live', 'animate');
    await studio.drop(join(root, 'protocol/examples/performances/hello.json'));
    await page.locator('.driver').getByText('Playing hello.json').waitFor();
    await studio.drawn(10);
    const group = page.locator('.fap-group').first();
    await group.locator('summary').click();
    await group.locator('input[type=range]').first().press('ArrowRight');
    await page.locator('.driver').getByText('By hand').waitFor();
    await group.locator('summary').click();
    await page.locator('.driver').getByRole('button').click();
    await page.locator('.driver').getByText(/^Live: /).waitFor();
    await studio.drawn(10);
    expect((await fetch(`${server.url}/v1/models/${other}`, { method: 'DELETE' })).status).toBe(204);
    await page.waitForFunction(() => document.querySelectorAll('.head').length === 1); // until the page has heard of it
  };

  const held = async (): Promise<Held> => {
    await page.waitForFunction(() => document.querySelector('.toast') === null);
    const scripts = await heldByScripts(devtools);
    const { nodes, jsEventListeners } = await devtools.send('Memory.getDOMCounters');
    const gpu = await page.evaluate(() => ({ ...(window as unknown as { gpuObjects: Record<string, number> }).gpuObjects }));
    return { gpu, nodes, listeners: jsEventListeners, scripts };
  };

  for (let i = 0; i < warmUp; i += 1) await round();
  let before = await held();
  let grown: string[] = [];
  for (let stretch = 0; stretch < stretches; stretch += 1) {
    const end = Date.now() + seconds * 1000;
    let rounds = 0;
    while (rounds < fewRounds || Date.now() < end) {
      await round();
      rounds += 1;
    }
    const after = await held();
    const told = ({ scripts, ...others }: Held): object => ({ ...others, bytes: bytesOf(scripts) });
    console.info(`${rounds} rounds, before and after: ${JSON.stringify([told(before), told(after)])}; ${growthOf(before.scripts, after.scripts)}`);
    grown = whatGrew(before, after, rounds);
    if (grown.length === 0) break;
    before = after;
  }
  expect(grown).toEqual([]);
  expect(studio.errors).toEqual([]);
  await studio.close();
}, stretches * (seconds * 2000 + 600_000) + 600_000);

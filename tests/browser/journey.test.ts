import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { quickSet } from '@protocol/generated/mpeg4.ts';
import { portuguese } from '../../web/src/words/portuguese.ts';
import { chooseFile, FingerHand, KeyboardHand, MouseHand, type Hand } from './support/hands.ts';
import { buildDir } from './support/paths.ts';
import { phone, StudioPage, type Inside, type OpenOptions } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';
import { everyVariant } from './support/variants.ts';

/** What a person does, at most, until a bare avatar talks: the measure of the way through the studio. */
const mostActs = { found: 5, placed: 13 };
/** The time that a person needs for it, seconds, without that of the machine; see support/hands.ts. */
const mostSeconds = { found: 30, placed: 90 };
/** Keys pressed until a bare avatar talks, by keyboard alone. */
const mostKeys = 110;
/** The server proposes the other points from so many. */
const pointsByHand = 8;

const folder = mkdtempSync(join(tmpdir(), 'semblante-journey-'));
const avatar = join(folder, 'sample-body.glb');
let places: Record<string, { position: [number, number, number] }>;

useStudio({ demo: false, voice: join(buildDir, 'bin/semblante-voice-espeak') });
beforeAll(() => {
  execFileSync(join(buildDir, 'bin/semblante-sample-head'), [folder, 'body']);
  ({ points: places } = JSON.parse(readFileSync(join(folder, 'sample-body.fps.json'), 'utf8')) as { points: typeof places });
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

/**
 * Where a person puts a point: the lips of the avatar touch, and nobody hits an edge that is a tenth of a millimetre from the other,
 * but anybody sees which lip is which.
 */
function aimOf(id: string): [number, number, number] {
  const [x, y, z] = places[id]!.position;
  return [x, y + (id === '2.2' ? besideEdge : id === '2.3' ? -besideEdge : 0), z];
}
const besideEdge = 0.0012; // metres

interface Way {
  name: string;
  /** Done only with `everyVariant`: the others have each hand and each language. */
  extra?: true;
  /** Points are found by the shape of the face, or placed by hand, as on heads that show none. */
  points: 'found' | 'placed';
  options: OpenOptions;
  makeHand: () => Hand;
}
const ways: Way[] = [
  { name: 'ByMouse_English', points: 'found', options: { width: 1440, height: 900, locale: 'en-US' }, makeHand: () => new MouseHand() },
  { name: 'ByKeyboard_English', extra: true, points: 'found', options: { width: 1100, height: 700, locale: 'en-US' }, makeHand: () => new KeyboardHand() },
  { name: 'ByMouse_Portuguese', extra: true, points: 'placed', options: { width: 1024, height: 768, locale: 'pt-BR' }, makeHand: () => new MouseHand() },
  { name: 'ByKeyboard_Portuguese', points: 'placed', options: { width: 1100, height: 700, locale: 'pt-BR' }, makeHand: () => new KeyboardHand() },
  { name: 'ByFinger_English', extra: true, points: 'placed', options: { ...phone, locale: 'en-US' }, makeHand: () => new FingerHand() },
  { name: 'ByFinger_Portuguese', points: 'found', options: { ...phone, locale: 'pt-BR' }, makeHand: () => new FingerHand() },
];

interface Recordings {
  recordings: { state: string; model: string; sound: boolean; duration: number }[];
}

/** Until a stream has moved the face. */
const movedByAStream = (studio: StudioPage): Promise<void> =>
  studio.page.evaluate(
    () =>
      new Promise<void>((done) => {
        const { driver, scene } = (window as unknown as Watched).semblante;
        const neutral = scene.face.mesh.positions.slice();
        const look = (): void => {
          const { kernel, poseNumber } = scene.performer.value!;
          if (driver.source.value === 'stream') kernel.deform(poseNumber);
          if (driver.source.value === 'stream' && kernel.positions.some((value, i) => Math.abs(value - neutral[i]!) > 1e-4)) done();
          else setTimeout(look, 50);
        };
        look();
      }),
  );
interface Watched {
  semblante: {
    driver: Inside['semblante']['driver'];
    scene: Inside['semblante']['scene'] & { face: { mesh: { positions: Float32Array } } };
  };
}

describe('from a bare avatar to a talking face and a recording', () => {
  for (const { name, options, makeHand, points: way } of ways.filter(({ extra }) => everyVariant || !extra)) {
    test(`Journey_${name}`, async () => {
      const studio = await StudioPage.open(browser, server.url, options);
      const { page } = studio;
      const hand = makeHand();
      const isNarrow = options.width! < 1080;
      const words = (english: keyof typeof portuguese): string => (options.locale === 'pt-BR' ? portuguese[english] : english);
      const button = (english: keyof typeof portuguese): ReturnType<typeof page.getByRole> =>
        page.getByRole('button', { name: words(english), exact: true });
      await studio.waitForStage('ready');

      // 1. The avatar.
      await chooseFile(page, hand, isNarrow ? page.locator('.top').getByRole('button', { name: words('Upload a head') }) : page.locator('.shelf-panel .drop'), avatar);
      await studio.waitForState('ready');
      await studio.waitForStage('ready');
      const points = page.locator('#tab-points');
      if ((await points.getAttribute('aria-selected')) !== 'true') await hand.press(points);

      // 2. The points: by a press, or the first ones each where the panel asks for it.
      if (way === 'found') {
        await hand.press(button('Find the points'));
      } else {
        const start = button('Start');
        if (await start.isVisible()) await hand.press(start);
        for (const [i, id] of quickSet.slice(0, pointsByHand).entries()) {
          await page.waitForFunction((asked) => location.hash.includes(`point=${asked}`), id);
          await studio.drawn(3);
          await hand.placeAt(studio, aimOf(id));
          await page.getByText(new RegExp(`\\b${i + 1} .*84`)).first().waitFor();
        }
        await hand.press(button('Propose missing points'));
      }
      await button('Confirm all').waitFor();
      await hand.press(button('Make it move (parametrize)'));
      await studio.waitForState('parametrized');
      await studio.waitForStage('ready');

      // 3. It talks.
      await page.locator('#tab-animate[aria-selected="true"]').waitFor();
      await hand.press(button('Speak')); // the example that stands in the empty field
      await page.waitForFunction(() => (window as unknown as Inside).semblante.driver.source.value === 'speech');
      await studio.keep(`journey-${name}`);
      console.info(`${name}, it talks: ${hand.acts} acts, ${hand.keys} keys, ${hand.seconds.toFixed(0)} s`);
      expect(hand.acts).toBeLessThanOrEqual(mostActs[way]);
      expect(hand.seconds).toBeLessThanOrEqual(mostSeconds[way]);
      expect(hand.keys).toBeLessThanOrEqual(mostKeys);

      // 4. A video of the avatar that talks, with its sound; it ends with the speech.
      await page.waitForFunction(() => (window as unknown as Inside).semblante.driver.source.value !== 'speech');
      await hand.press(button('Video'));
      await button('Stop and save').waitFor();
      const [video] = await studio.seen(() => Promise.all([page.waitForEvent('download'), hand.press(button('Again'))]));
      expect(video.suggestedFilename()).toBe('sample-body.webm');
      expect(statSync(await video.path()).size).toBeGreaterThan(10_000);

      // 5. A stream says it too: it is followed at once, and a recording of it is kept.
      const followed = movedByAStream(studio); // from before the press on: the speech takes seconds
      await hand.press(button('Speak into a stream'));
      await page.waitForFunction(() => (window as unknown as Inside).semblante.driver.source.value === 'stream');
      const stream = await page.evaluate(() => (window as unknown as Inside).semblante.live.following.value!);
      const model = await page.evaluate(() => (window as unknown as Inside).semblante.studio.selected.value!.id);
      await followed;
      await studio.keep(`journey-${name}-stream`);
      await hand.press(button('Show the recording'));
      await page.locator('.recordings .recording').first().waitFor();
      const { recordings } = (await (await fetch(`${server.url}/v1/streams/${stream}/recordings`)).json()) as Recordings;
      expect(recordings).toHaveLength(1);
      const [recording] = recordings;
      expect(recording).toMatchObject({ state: 'finished', model, sound: true });
      expect(recording!.duration).toBeGreaterThan(1000);
      await studio.keep(`journey-${name}-recording`);
      console.info(`${name}, recorded: ${hand.acts} acts, ${hand.keys} keys, ${hand.seconds.toFixed(0)} s`);
      expect(studio.errors).toEqual([]);
      await studio.close();
    });
  }
});

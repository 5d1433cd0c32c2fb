import { expect, test } from 'vitest';
import { EditedGlb } from './support/edit_glb.ts';
import { sampleHead } from './support/paths.ts';
import { StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';
import { parametrizeAsSample, uploadHead } from './support/uploads.ts';

type Vector = [number, number, number];

interface Eye {
  pivot: Vector;
  axis: Vector;
  irisRadius: number;
  pupilRadius: number;
  /** Distance of the pupil from the pivot. */
  ball: number;
}

/** What holds a frame on the page. */
interface Holder {
  frame: { levels: Int32Array };
  byRecording(moment: { levels: Int32Array }): void;
}

/** How far a rim in the picture may be from its radius, and its middle from its place, in radii of the iris. */
const tolerance = 0.08;
const centreTolerance = 0.05;
const directions = 64;
const degree = Math.PI / 180;
const turn = (ray: number): number => (2 * Math.PI * ray) / directions;

useStudio({ demo: false });

/** The sample head without the materials of its eyes. */
function withoutIrises(): Uint8Array<ArrayBuffer> {
  const head = new EditedGlb(sampleHead);
  let changed = 0;
  for (const mesh of head.gltf.meshes.filter(({ name }) => / eye$/.test(name))) {
    for (const primitive of mesh.primitives) {
      delete primitive.material;
      changed += 1;
    }
  }
  expect(changed).toBe(2);
  return head.bytes();
}

async function upload(): Promise<string> {
  const id = await uploadHead('eyes', withoutIrises());
  await parametrizeAsSample(id);
  return id;
}

async function leftEye(id: string): Promise<Eye> {
  const rig = (await (await fetch(`${server.url}/v1/models/${id}/rig.json`)).json()) as {
    eye_pivots: [Vector, Vector];
    irises: { axis: Vector; iris_radius: number; pupil_radius: number }[];
    lids: { ball: number[] }[];
  };
  const [iris] = rig.irises;
  return {
    pivot: rig.eye_pivots[0],
    axis: iris!.axis,
    irisRadius: iris!.iris_radius,
    pupilRadius: iris!.pupil_radius,
    ball: rig.lids[0]!.ball[0]!,
  };
}

/** Yaw after pitch, as SPEC 1.4 turns an eye. */
function turned([x, y, z]: Vector, pitch: number, yaw: number): Vector {
  const [s, c] = [Math.sin(pitch), Math.cos(pitch)];
  const [py, pz] = [c * y - s * z, s * y + c * z];
  const [t, d] = [Math.sin(yaw), Math.cos(yaw)];
  return [d * x + t * pz, py, d * pz - t * x];
}

/** Where on the ball a line along the gaze, `radius` beside it, pierces it. The sample head looks along z. */
function pierced(eye: Eye, radius: number, direction: number, pitch: number, yaw: number): Vector {
  expect(eye.axis[2]).toBeGreaterThan(0.9999);
  const [x, y] = [radius * Math.cos(direction), radius * Math.sin(direction)];
  const place = turned([x, y, Math.sqrt(eye.ball ** 2 - radius ** 2)], pitch, yaw);
  return [0, 1, 2].map((i) => eye.pivot[i]! + place[i]!) as Vector;
}

/** The brightness of the stage at places of the model. */
async function brightness(studio: StudioPage, picture: Buffer, places: Vector[]): Promise<number[]> {
  return studio.page.evaluate(
    async ({ base64, at }) => {
      const { scene } = (window as unknown as Inside).semblante;
      const image = await createImageBitmap(
        new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: 'image/png' }),
      );
      const canvas = new OffscreenCanvas(image.width, image.height);
      const context = canvas.getContext('2d')!;
      context.drawImage(image, 0, 0);
      const { data } = context.getImageData(0, 0, image.width, image.height);
      return at.map((place) => {
        const { x, y } = scene.markers.project(place, scene.stage.camera, image.width, image.height);
        const i = 4 * (Math.floor(y) * image.width + Math.floor(x));
        return (data[i]! + data[i + 1]! + data[i + 2]!) / 3;
      });
    },
    { base64: picture.toString('base64'), at: places },
  );
}

/** The middle of the circle with these distances from the origin by direction: least squares of r + x cos d + y sin d. */
function middleOf(rim: [number, number][]): [number, number] {
  const rows = [0, 1, 2].map(() => [0, 0, 0, 0]);
  for (const [direction, distance] of rim) {
    const terms = [1, Math.cos(direction), Math.sin(direction), distance];
    for (let i = 0; i < 3; i += 1) for (let k = 0; k < 4; k += 1) rows[i]![k]! += terms[i]! * terms[k]!;
  }
  const determinant = (a: number, b: number, c: number): number => {
    const [p, q, r] = rows.map((row) => [row[a]!, row[b]!, row[c]!]) as [number[], number[], number[]];
    return (
      p[0]! * (q[1]! * r[2]! - q[2]! * r[1]!) -
      p[1]! * (q[0]! * r[2]! - q[2]! * r[0]!) +
      p[2]! * (q[0]! * r[1]! - q[1]! * r[0]!)
    );
  };
  const all = determinant(0, 1, 2);
  return [determinant(0, 3, 2) / all, determinant(0, 1, 3) / all];
}

test('Gaze_EyesWithoutAnIrisOfTheFile_AreRoundWhereTheGazePiercesThem', async () => {
  const id = await upload();
  const eye = await leftEye(id);
  expect(eye.pupilRadius / eye.irisRadius).toBeCloseTo(1 / 3, 5);
  const studio = await StudioPage.open(browser, `${server.url}/#${id}`, { width: 1300, height: 1000, sharp: true });
  await studio.waitForStage('ready');
  await studio.page.evaluate((place) => {
    const { scene } = (window as unknown as { semblante: { scene: { stage: { look(view: string): void; focus(at: Vector): void } } } }).semblante;
    scene.stage.look('front');
    scene.stage.focus(place);
  }, eye.pivot);
  // Ahead and into the corners.
  for (const [pitch, yaw] of [[0, 0], [-20, -20], [-20, 20], [20, -20], [20, 20]] as const) {
    const words = `pitch ${pitch}, yaw ${yaw}`;
    // The lids wide open: they would cover most of the iris.
    const level = (angle: number): number => Math.round((angle * degree * 1e5) / 128);
    const angle = (levels: number): number => (levels * 128) / 1e5;
    const [p, y] = [level(pitch), level(yaw)];
    await studio.page.evaluate((faps) => {
      const { driver } = (window as unknown as { semblante: { driver: Holder } }).semblante;
      const moment = structuredClone(driver.frame);
      for (const [number, value] of Object.entries(faps)) moment.levels[Number(number)] = value;
      driver.byRecording(moment);
    }, { 19: -768, 20: -768, 21: -560, 22: -560, 23: y, 24: y, 25: p, 26: p });
    const picture = await studio.pictureAtRest();
    for (const [name, rim, inside, outside, widest] of [
      ['iris', eye.irisRadius, 0.85, 1.2, 25],
      ['pupil', eye.pupilRadius, 0.12, 0.6, 90],
    ] as const) {
      // Rays from inside to outside of the rim, in steps of a hundredth; not those across the lids.
      const rays = [...Array(directions).keys()].filter(
        (k) => Math.abs(Math.sin(turn(k))) <= Math.sin(widest * degree),
      );
      const steps = Math.round((outside - inside) * 100);
      const places = rays.flatMap((k) =>
        [...Array(steps + 1).keys()].map((s) =>
          pierced(eye, (inside + s / 100) * eye.irisRadius, turn(k), angle(p), angle(y)),
        ),
      );
      const seen = await brightness(studio, picture, places);
      /** By ray: where its rim is, in radii of the iris, if it is where it should be. */
      const good = new Map<number, number>();
      for (const [r, k] of rays.entries()) {
        const ray = seen.slice(r * (steps + 1), (r + 1) * (steps + 1));
        const [dark, bright] = [ray[0]!, ray[steps]!];
        const at = inside + ray.findIndex((value) => value >= (dark + bright) / 2) / 100;
        if (bright - dark > 12 && Math.abs(at - rim / eye.irisRadius) < tolerance) good.set(k, at);
      }
      // The light's glint lies on some, mostly of the pupil.
      expect(good.size / rays.length, `${name}, ${words}`).toBeGreaterThan(0.6);
      const [right, up] = middleOf([...good].map(([k, at]) => [turn(k), at]));
      expect(Math.hypot(right, up), `centre of the ${name}, ${words}`).toBeLessThan(centreTolerance);
    }
  }
  expect(studio.errors).toEqual([]);
  await studio.close();
});

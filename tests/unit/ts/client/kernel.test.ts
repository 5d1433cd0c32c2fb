import { readFileSync } from 'node:fs';
import { beforeAll, describe, expect, it } from 'vitest';
import { writeFrame } from '../../../../clients/js/frames.ts';
import { Kernel, neutralFrame, Runtime, type Face, type FaceFrame } from '../../../../clients/js/index.ts';
import { frameLayout } from '../../../../clients/js/generated/layouts.ts';
import { fullTurn, rigFapus, type QuantizerSteps, type RigDocument, type Vec3 } from '../../../../protocol/ts/index.ts';
import { featurePoints } from '../../../../protocol/ts/generated/mpeg4.ts';
import { loadRuntime, viewPath } from '../support/runtime.ts';

type Sparse = Record<string, Vec3>;
/** Dense numbers of point and leader, share. */
type Followers = [number, number, number][];
interface Vectors {
  rig: {
    fapu: number[];
    eye_pivot: [Vec3, Vec3];
    head_pivot: Vec3;
    irises?: RigDocument['irises'];
    tongue?: RigDocument['tongue'];
    lids?: RigDocument['lids'];
    companions?: Followers;
    lower_lip?: Followers;
    viseme_share: number;
    visemes: Sparse[];
    expressions: Sparse[];
  };
  face: { rest: Vec3[]; normals?: Vec3[]; triangles?: Vec3[]; rows: [number, number][][]; rigid: number[]; turn?: number[] };
  cases: {
    name: string;
    frame: Pick<FaceFrame, 'viseme' | 'expression'> & { faps: Record<string, number> };
    jaw_takes_lip?: boolean;
    displacements: Sparse;
    positions: number[];
  }[];
  interpolations: { from: number; to: number; t: number; positions: number[] }[];
}
/** Has no displacements, but normals. */
interface Golden extends Vectors {
  tolerance: { position: number; normal_degrees: number };
  cases: (Vectors['cases'][number] & { vertex_normals: number[] })[];
  interpolations: (Vectors['interpolations'][number] & { vertex_normals: number[] })[];
}
const read = (name: string): unknown =>
  JSON.parse(readFileSync(new URL(`../../../../protocol/vectors/kernel/${name}`, import.meta.url), 'utf8'));
const vectors = read('small-face.json') as Vectors;
const golden = read('golden-frames.json') as Golden;

function faceOf({ rig, face }: Vectors): Face {
  const named = (set: Sparse) => ({
    name: '',
    displacements: Object.fromEntries(Object.entries(set).map(([fp, by]) => [featurePoints[Number(fp)]!.id, by])),
  });
  const followers = (list: Followers = []) =>
    list.map(([point, leader, share]) => ({ point: featurePoints[point]!.id, leader: featurePoints[leader]!.id, share }));
  const offsets = [0];
  for (const row of face.rows) offsets.push(offsets.at(-1)! + row.length);
  return {
    rig: {
      fapu: Object.fromEntries(rigFapus.map((unit, i) => [unit, rig.fapu[i]])),
      eye_pivots: rig.eye_pivot,
      head_pivot: rig.head_pivot,
      irises: rig.irises ?? [null, null],
      tongue: rig.tongue ?? null,
      lids: rig.lids ?? [null, null],
      companions: followers(rig.companions),
      lower_lip: followers(rig.lower_lip),
      viseme_share: rig.viseme_share,
      visemes: rig.visemes.map(named),
      expressions: rig.expressions.map(named),
    } as unknown as RigDocument,
    mesh: {
      positions: Float32Array.from(face.rest.flat()),
      normals: face.normals ? Float32Array.from(face.normals.flat()) : null,
      triangles: Uint32Array.from((face.triangles ?? []).flat()),
    } as Face['mesh'],
    influence: {
      vertexCount: face.rest.length,
      rowOffsets: Uint32Array.from(offsets),
      rowPoints: Uint8Array.from(face.rows.flat().map(([point]) => point)),
      rowWeights: Float32Array.from(face.rows.flat().map(([, weight]) => weight)),
      rigid: Uint8Array.from(face.rigid),
      turn: face.turn ? Uint8Array.from(face.turn) : new Uint8Array(face.rest.length).fill(fullTurn),
    } as Face['influence'],
  };
}

/** The vectors have FAPs in FAP units: one level each, of a step that is the value. */
function frameOf(given: Vectors['cases'][number]['frame']): [FaceFrame, QuantizerSteps] {
  const frame = { ...neutralFrame(), viseme: given.viseme, expression: given.expression };
  const steps = new Float64Array(69).fill(1);
  for (const [fap, value] of Object.entries(given.faps)) {
    frame.levels[Number(fap)] = 1;
    steps[Number(fap)] = value;
  }
  return [frame, steps];
}

const distance = (a: ArrayLike<number>, b: ArrayLike<number>, v: number): number =>
  Math.hypot(a[v * 3]! - b[v * 3]!, a[v * 3 + 1]! - b[v * 3 + 1]!, a[v * 3 + 2]! - b[v * 3 + 2]!);

/** The largest angle between unit vectors, degrees. */
function worstAngle(a: ArrayLike<number>, b: ArrayLike<number>): number {
  let worst = 0;
  for (let v = 0; v < b.length / 3; ++v) worst = Math.max(worst, distance(a, b, v));
  return (2 * Math.asin(Math.min(1, worst / 2)) * 180) / Math.PI;
}

describe('Kernel', () => {
  let runtime: Runtime;
  beforeAll(async () => {
    runtime = await loadRuntime();
  });

  it('EvaluateAndDeform_GoldenFrames_GiveTheGoldenNumbers', async () => {
    const kernel = new Kernel(runtime, faceOf(vectors), { poseCount: vectors.cases.length + 1 });
    vectors.cases.forEach((each, pose) => {
      const [frame, steps] = frameOf(each.frame);
      kernel.evaluate(frame, pose, steps);
      const expected = new Float32Array(84 * 3);
      for (const [fp, by] of Object.entries(each.displacements)) expected.set(by, Number(fp) * 3);
      expect(kernel.poses[pose]!.featurePoints.map((x) => x + 0), each.name).toEqual(expected);
      kernel.deform(pose);
      expect(kernel.positions.map((x) => x + 0), each.name).toEqual(Float32Array.from(each.positions));
    });
    const out = vectors.cases.length;
    for (const { from, to, t, positions } of vectors.interpolations) {
      kernel.interpolate(from, to, t, out);
      kernel.deform(out);
      expect(kernel.positions.map((x) => x + 0)).toEqual(Float32Array.from(positions));
    }
  });

  it('Ease_FromRestToRest_IsTheSmoothStepOfTheWay', async () => {
    const kernel = new Kernel(runtime, faceOf(vectors), { poseCount: 5 });
    const [frame, steps] = frameOf(vectors.cases[3]!.frame);
    kernel.evaluate(frame, 2, steps);
    const to = kernel.poses[2]!.featurePoints;
    const moved = to.findIndex((x) => x !== 0);
    kernel.ease([3, 1, 2, 4], [0, 40, 0], 0.25, 0);
    expect(kernel.poses[0]!.featurePoints[moved]).toBeCloseTo(to[moved]! * 0.25 * 0.25 * 2.5, 6);
    // With the same slope on both sides it goes on straight: pose 3 as far behind as 2 is ahead, 4 twice as far.
    kernel.poses[3]!.featurePoints.forEach((_, i, all) => (all[i] = -to[i]!));
    kernel.poses[4]!.featurePoints.forEach((_, i, all) => (all[i] = 2 * to[i]!));
    kernel.ease([3, 1, 2, 4], [40, 40, 40], 0.25, 0);
    expect(kernel.poses[0]!.featurePoints[moved]).toBeCloseTo(to[moved]! * 0.25, 6);
  });

  it('Deform_WithNormals_GivesTheGoldenNormals', async () => {
    const out = golden.cases.length;
    const kernel = new Kernel(runtime, faceOf(golden), { poseCount: out + 1, withNormals: true });
    const neutral = golden.cases.find(({ name }) => name === 'neutral')!;
    expect(worstAngle(kernel.normals, neutral.vertex_normals)).toBeLessThan(golden.tolerance.normal_degrees);
    const check = (name: string, pose: number, positions: number[], normals: number[]): void => {
      kernel.deform(pose);
      expect(Math.max(...positions.map((x, i) => Math.abs(x - kernel.positions[i]!))), name).toBeLessThan(
        golden.tolerance.position,
      );
      expect(kernel.normals.length).toBe(normals.length);
      expect(worstAngle(kernel.normals, normals), name).toBeLessThan(golden.tolerance.normal_degrees);
    };
    golden.cases.forEach((each, pose) => {
      kernel.setJawTakesLip(each.jaw_takes_lip ?? false);
      const [frame, steps] = frameOf(each.frame);
      kernel.evaluate(frame, pose, steps);
      check(each.name, pose, each.positions, each.vertex_normals);
    });
    for (const { from, to, t, positions, vertex_normals } of golden.interpolations) {
      kernel.interpolate(from, to, t, out);
      check(`${from} to ${to}`, out, positions, vertex_normals);
    }
    // What was shown before leaves nothing behind.
    check('neutral again', golden.cases.indexOf(neutral), neutral.positions, neutral.vertex_normals);
  });

  it('Create_WithNormalsOfAMeshWithoutAny_JoinsWhatSharesAPlace', async () => {
    const face = faceOf(golden);
    face.mesh.normals = null;
    const kernel = new Kernel(runtime, face, { withNormals: true });
    const { rest } = golden.face;
    let joined = 0;
    rest.forEach((place, v) => {
      const first = rest.findIndex((other) => other.every((x, i) => x === place[i]));
      if (first === v) return;
      joined += 1;
      expect(kernel.normals.subarray(v * 3, v * 3 + 3)).toEqual(kernel.normals.subarray(first * 3, first * 3 + 3));
    });
    expect(joined).toBeGreaterThan(0);
  });

  it('Create_WithoutNormals_HasNone', async () => {
    expect(new Kernel(runtime, faceOf(golden)).normals.length).toBe(0);
    const poses = new Kernel(runtime, faceOf(golden), { withVertices: false, withNormals: true });
    expect(poses.normals.length).toBe(0);
  });

  it('Create_PosesAreNeutralAndPositionsAtRest', async () => {
    const kernel = new Kernel(runtime, faceOf(vectors));
    expect(kernel.positions).toEqual(Float32Array.from(vectors.face.rest.flat()));
    expect(kernel.poses.length).toBe(3);
    expect(Array.from(kernel.poses[0]!.headRotation)).toEqual([0, 0, 0, 1]);
    expect(Array.from(kernel.poses[2]!.headPivot)).toEqual(Array.from(Float32Array.from(vectors.rig.head_pivot)));
  });

  it('SetVisemeShare_AtAPointThatBothMove_SplitsByIt', async () => {
    const viseme: Vec3 = [0.5, -1, 0.25];
    const expression: Vec3 = [0, 2, -0.5];
    const rig = {
      ...vectors.rig,
      visemes: vectors.rig.visemes.map((set, i) => (i === 10 ? { '0': viseme } : set)),
      expressions: vectors.rig.expressions.map((set, i) => (i === 1 ? { '0': expression } : set)),
    };
    const kernel = new Kernel(runtime, faceOf({ ...vectors, rig }));
    const frame = neutralFrame();
    frame.viseme = { select1: 10, select2: 0, blend: 63 };
    frame.expression = { select1: 1, intensity1: 63, select2: 0, intensity2: 0 };
    const moved = (share: number | null): number[] => {
      kernel.setVisemeShare(share);
      kernel.evaluate(frame, 0);
      return Array.from(kernel.poses[0]!.featurePoints.subarray(0, 3));
    };
    expect(moved(0)).toEqual(expression);
    expect(moved(1)).toEqual(viseme);
    expect(moved(0.25)).toEqual([0.125, 1.25, -0.3125]);
    const own = moved(null);
    own.forEach((x, i) => expect(x).toBeCloseTo(0.85 * viseme[i]! + 0.15 * expression[i]!, 6));
    for (const share of [-0.01, 1.01, NaN]) expect(() => kernel.setVisemeShare(share)).toThrow(RangeError);
    expect(moved(null)).toEqual(own);
  });

  it('Create_WithoutVertices_GivesPosesAlone', async () => {
    const kernel = new Kernel(runtime, faceOf(vectors), { withVertices: false });
    const [frame, steps] = frameOf(vectors.cases[3]!.frame);
    kernel.evaluate(frame, 0, steps);
    expect(kernel.poses[0]!.featurePoints.some((x) => x !== 0)).toBe(true);
    expect(() => kernel.deform(0)).toThrow(RangeError);
    expect(() => kernel.evaluate(frame, 3)).toThrow(RangeError);
  });

  it('EvaluateAt_OfAFrameInTheLibrary_IsEvaluate_AndOfAnotherInstanceThrows', async () => {
    const kernel = new Kernel(runtime, faceOf(vectors));
    const [frame, steps] = frameOf(vectors.cases[3]!.frame);
    kernel.evaluate(frame, 0, steps);
    const at = runtime.alloc(frameLayout.bytes);
    writeFrame(runtime.view, at, frame, steps);
    kernel.evaluateAt(runtime, at, 1);
    expect(kernel.poses[1]).toEqual(kernel.poses[0]);
    expect(() => kernel.evaluateAt(runtime, at, 3)).toThrow(RangeError);
    const other = await Runtime.open(readFileSync(viewPath));
    expect(() => kernel.evaluateAt(other, at, 1)).toThrow(/another instance/);
    runtime.free(at);
  });

  it('Positions_AfterTheMemoryHasGrown_AreThoseOfTheNewMemory', () => {
    const kernel = new Kernel(runtime, faceOf(vectors));
    const before = kernel.positions;
    const pose = kernel.poses[0]!;
    const big = runtime.alloc(runtime.bytes.length);
    expect(before.length).toBe(0); // that is what growing does to a view
    expect(pose.headRotation.length).toBe(0);
    expect(kernel.positions).toEqual(Float32Array.from(vectors.face.rest.flat()));
    expect(Array.from(kernel.poses[0]!.headRotation)).toEqual([0, 0, 0, 1]);
    runtime.free(big);
  });

  it('Create_WhileTheMemoryGrows_GivesTheSameFace', async () => {
    const own = await Runtime.open(readFileSync(viewPath));
    const face = faceOf(golden);
    const first = new Kernel(own, face, { withNormals: true });
    const normals = first.normals.slice();
    const kernels = [first];
    let grown = 0;
    while (grown < 20) {
      const before = own.bytes.length;
      kernels.push(new Kernel(own, face, { withNormals: true }));
      if (own.bytes.length > before) grown += 1;
    }
    for (const kernel of kernels) expect(kernel.normals).toEqual(normals);
  });

  it('Dispose_AThousandTimes_GivesTheMemoryBack', () => {
    new Kernel(runtime, faceOf(golden), { withNormals: true }).dispose();
    const before = runtime.bytes.length;
    for (let i = 0; i < 1000; ++i) new Kernel(runtime, faceOf(golden), { withNormals: true }).dispose();
    expect(runtime.bytes.length).toBe(before);
  });
});

import type { FaceFrame } from '../../protocol/ts/face_frame.ts';
import { fapCount, featurePointCount } from '../../protocol/ts/generated/mpeg4.ts';
import { standardQuantizers, type QuantizerSteps } from '../../protocol/ts/quantizers.ts';
import {
  ballPlaces,
  featurePointIndex,
  rigFapus,
  type DisplacementSet,
  type RigDocument,
  type RigLids,
} from '../../protocol/ts/rig_document.ts';
import type { Face } from './face.ts';
import { FaceError } from './face_error.ts';

// Layout of the structures of core/kernel/semblante_kernel.h with 4-byte pointers.
const frameBytes = 8 + (fapCount + 1) * 4;
const rigFloatsAt = 8;
const rigFloats = (160 - rigFloatsAt) / 4; // up to the pointer of companions
const companionsAt = 160;
const lipShareAt = 168;
const lidsAt = 172;
const lidFloats = 3 + 4 + ballPlaces;
const rigBytes = lidsAt + 2 * lidFloats * 4;
const visemeShareAt = 64;
const companionBytes = 8;
const faceBytes = 28;
const trianglesBytes = 16;
const irisFloats = 6;
const tongueFloats = 11;
const poseFloats = featurePointCount * 3 + 2 * 4 + 2 * 3 + 4 + 2 * 3 + 3 + 2 + 1 + 2 * irisFloats + tongueFloats + 4 + 2 * lidFloats;

interface KernelExports {
  memory: WebAssembly.Memory;
  semblante_alloc(bytes: number): number;
  semblante_evaluate(rig: number, frame: number, pose: number): void;
  semblante_interpolate(a: number, b: number, t: number, out: number): void;
  semblante_ease(before: number, from: number, to: number, after: number, spans: number, t: number, out: number): void;
  semblante_prepared_size(face: number): number;
  semblante_prepare(face: number, memory: number): number;
  semblante_join_scratch(vertices: number): number;
  semblante_join_seams(vertices: number, positions: number, normals: number, scratch: number, joined: number): void;
  semblante_normals(triangles: number, positions: number, normals: number): void;
  semblante_deform_changed(face: number, before: number, now: number, positions: number): number;
}

export interface KernelOptions {
  /** Number of poses that the kernel holds. Default: 3. */
  poseCount?: number;
  /** Default: true. */
  withVertices?: boolean;
  /** Default: false. */
  withNormals?: boolean;
}

/**
 * A pose: displacements of the feature points and motions of the rigid parts. The arrays are views of kernel memory.
 */
export interface Pose {
  /** 84 by 3: displacement of each feature point, model units */
  readonly featurePoints: Float32Array;
  /** left, right; unit quaternions x, y, z, w */
  readonly eyeRotations: Float32Array;
  readonly eyeTranslations: Float32Array;
  readonly headRotation: Float32Array;
  readonly eyePivots: Float32Array;
  readonly headPivot: Float32Array;
  /** left, right: growth of the pupil's radius, model units */
  readonly pupilGrowth: Float32Array;
  /** 1 element: upward angle of the tongue's borders, radians */
  readonly tongueRoll: Float32Array;
  /** left, right: axis, pupil radius (0: no iris), iris radius, bend */
  readonly irises: Float32Array;
  /** origin, left, up, half width (0: no tongue), limit of the roll */
  readonly tongue: Float32Array;
  /** left, right; upper, lower: share of the slit that the lid has closed */
  readonly lidClosures: Float32Array;
  /** left, right; `lidFields` floats each */
  readonly lids: Float32Array;
}

/** The points of the lids of the left eye; those of the right eye are the next. */
export const lidPoints = { upper: featurePointIndex('3.1')!, lower: featurePointIndex('3.3')! } as const;
export { ballPlaces };

/** Members of one eye in `Pose.lids`, as indices of floats. */
export const lidFields = {
  gaze: 0,
  slit: 3,
  /** 0: the lids do not slide */
  opening: 4,
  ball: 7,
  count: lidFloats,
} as const;

/** Compiles the kernel, for any number of faces. `source`: the bytes or the response of a fetch. */
export async function compileKernel(source: BufferSource | Response | Promise<Response>): Promise<WebAssembly.Module> {
  const given = await source;
  return WebAssembly.compile(given instanceof Response ? await given.arrayBuffer() : given);
}

/**
 * One face in the WebAssembly build of core/kernel: evaluates frames to poses (Eq. 5, 6) and poses to vertices (Eq. 7).
 * Holds `poseCount` poses, identified by number. All memory is allocated at creation, so that the views stay valid.
 */
export class Kernel {
  /** #V by 3: output of `deform`. Read only: `deform` updates only the vertices that changed since the last call. */
  readonly positions: Float32Array;
  /** #V by 3, unit length: the normals of `positions`. Empty without the option `withNormals`. */
  readonly normals: Float32Array;
  readonly poses: readonly Pose[];

  private readonly exports: KernelExports;
  private readonly frameNumbers: Uint8Array;
  private readonly frameFaps: Float32Array;
  private readonly spans: Float32Array;
  /** the whole memory of the kernel */
  private readonly bytes: Uint8Array;
  private readonly share: Float32Array;
  private readonly shareOfRig: number;
  private readonly lipShare: Float32Array;
  private readonly at: {
    frame: number;
    spans: number;
    rig: number;
    /** address of the prepared face; 0 without vertices */
    face: number;
    positions: number;
    /** address of semblante_triangles; 0 without normals */
    triangles: number;
    normals: number;
    poses: number[];
    /** address of the pose of the current `positions` */
    shown: number;
  };

  /**
   * `withVertices: false` omits the influence table, for deformation on the GPU: `deform` must not be called and
   * `positions` is empty. `withNormals: true` makes `deform` also compute `normals` from the triangles, which takes
   * about as long as the vertices. Throws FaceError `memory` when the memory is exhausted.
   */
  static async create(
    module: WebAssembly.Module,
    face: Face,
    options: KernelOptions = {},
  ): Promise<Kernel> {
    const instance = await WebAssembly.instantiate(module, {});
    return new Kernel(instance.exports as unknown as KernelExports, face, options);
  }

  private constructor(exports: KernelExports, face: Face, options: KernelOptions) {
    this.exports = exports;
    const { influence, mesh, rig } = face;
    const vertices = (options.withVertices ?? true) ? influence.vertexCount : 0;
    const entries = vertices === 0 ? 0 : influence.rowPoints.length;
    const turned = options.withNormals ? vertices : 0; // number of vertices with a normal
    const corners = turned > 0 ? mesh.triangles.length : 0;
    let size = 0;
    const place = (bytes: number): number => {
      const offset = size;
      size = Math.ceil((size + bytes) / 16) * 16;
      return offset;
    };
    const frame = place(frameBytes);
    const spans = place(12);
    const rigAt = place(rigBytes);
    const faceAt = place(faceBytes);
    const visemes = place(rig.visemes.length * featurePointCount * 12);
    const expressions = place(rig.expressions.length * featurePointCount * 12);
    const followers = [...rig.companions, ...rig.lower_lip];
    const companions = place(followers.length * companionBytes);
    const poses = Array.from({ length: options.poseCount ?? 3 }, () => place(poseFloats * 4));
    const shown = place(poseFloats * 4);
    const rest = place(vertices * 12);
    const positions = place(vertices * 12);
    const rowOffsets = place((vertices + 1) * 4);
    const rowPoints = place(entries);
    const rowWeights = place(entries * 4);
    const rigid = place(vertices);
    const turn = place(vertices);
    const trianglesAt = place(trianglesBytes);
    const cornersAt = place(corners * 4);
    const joined = place(turned * 4);
    const normals = place(turned * 12);

    const base = alloc(exports, size);
    let memory = exports.memory.buffer;
    new Uint8Array(memory, base, size).fill(0);
    const floats = (offset: number, count: number): Float32Array => new Float32Array(memory, base + offset, count);

    floats(visemes, rig.visemes.length * featurePointCount * 3).set(flatten(rig.visemes));
    floats(expressions, rig.expressions.length * featurePointCount * 3).set(flatten(rig.expressions));
    new Uint32Array(memory, base + rigAt, 2).set([base + visemes, base + expressions]);
    floats(rigAt + rigFloatsAt, rigFloats).set(rigNumbers(rig));
    const companionView = new DataView(memory, base + companions, followers.length * companionBytes);
    followers.forEach(({ point, leader, share }, i) => {
      const isChoice = i >= rig.companions.length;
      companionView.setUint8(i * companionBytes, featurePointIndex(point)!);
      companionView.setUint8(i * companionBytes + 1, featurePointIndex(leader)!);
      companionView.setUint8(i * companionBytes + 2, isChoice ? 1 : 0);
      companionView.setFloat32(i * companionBytes + 4, share, true);
    });
    new Uint32Array(memory, base + rigAt + companionsAt, 2).set([base + companions, followers.length]);
    floats(rigAt + lidsAt, 2 * lidFloats).set(rig.lids.flatMap(lidNumbers));
    if (vertices > 0) {
      floats(rest, vertices * 3).set(mesh.positions);
      floats(positions, vertices * 3).set(mesh.positions);
      new Uint32Array(memory, base + rowOffsets, vertices + 1).set(influence.rowOffsets);
      new Uint8Array(memory, base + rowPoints, entries).set(influence.rowPoints);
      floats(rowWeights, entries).set(influence.rowWeights);
      new Uint8Array(memory, base + rigid, vertices).set(influence.rigid);
      new Uint8Array(memory, base + turn, vertices).set(influence.turn);
      new Uint32Array(memory, base + faceAt, 7).set([
        vertices,
        base + rest,
        base + rowOffsets,
        base + rowPoints,
        base + rowWeights,
        base + rigid,
        base + turn,
      ]);
    }
    if (turned > 0) {
      // A mesh without normals is treated as smooth: all vertices at one position share their normal.
      if (mesh.normals) floats(normals, turned * 3).set(mesh.normals);
      new Uint32Array(memory, base + cornersAt, corners).set(mesh.triangles);
      const numbers = [turned, corners / 3, base + cornersAt, base + joined];
      new Uint32Array(memory, base + trianglesAt, 4).set(numbers);
    }
    const prepared = vertices > 0 ? prepare(exports, base + faceAt) : 0;
    if (turned > 0) {
      const scratch = alloc(exports, exports.semblante_join_scratch(turned) * 4);
      exports.semblante_join_seams(turned, base + rest, base + normals, scratch, base + joined);
      exports.semblante_normals(base + trianglesAt, base + positions, base + normals);
    }
    memory = exports.memory.buffer; // after the last growth: views from here on stay valid

    this.at = {
      frame: base + frame,
      spans: base + spans,
      rig: base + rigAt,
      face: prepared,
      positions: base + positions,
      triangles: turned > 0 ? base + trianglesAt : 0,
      normals: base + normals,
      poses: poses.map((offset) => base + offset),
      shown: base + shown,
    };
    this.frameNumbers = new Uint8Array(memory, base + frame, 7);
    this.frameFaps = floats(frame + 8, fapCount + 1);
    this.spans = floats(spans, 3);
    this.bytes = new Uint8Array(memory);
    this.share = floats(rigAt + visemeShareAt, 1);
    this.shareOfRig = rig.viseme_share;
    this.lipShare = floats(rigAt + lipShareAt, 1);
    this.positions = floats(positions, vertices * 3);
    this.normals = floats(normals, turned * 3);
    this.poses = poses.map((offset) => poseViews(floats(offset, poseFloats)));
    for (const pose of [...this.at.poses, this.at.shown]) exports.semblante_evaluate(this.at.rig, this.at.frame, pose);
  }

  /**
   * Sets the viseme share of Eq. 5 (the weight of the viseme where an expression moves the same feature point, 0..1)
   * for later calls of `evaluate`; null: the rig's own. Throws RangeError.
   */
  setVisemeShare(share: number | null): void {
    if (share !== null && !(share >= 0 && share <= 1)) throw new RangeError('a viseme share must be between 0 and 1');
    this.share[0] = share ?? this.shareOfRig;
  }

  /**
   * Whether FAP 3 alone takes the lower lip along, for later calls of `evaluate`. By the standard it does not (false,
   * the default): streams move the lip by FAPs of its own, and these always win.
   */
  setJawTakesLip(takes: boolean): void {
    this.lipShare[0] = takes ? 1 : 0;
  }

  /**
   * Evaluates a frame to a pose (Eq. 5, 6). `steps`: the quantizer steps of the frame's stream, FAP units per level.
   */
  evaluate(frame: FaceFrame, pose: number, steps: QuantizerSteps = standardQuantizers): void {
    const { viseme, expression, levels } = frame;
    const numbers = this.frameNumbers;
    numbers[0] = viseme.select1;
    numbers[1] = viseme.select2;
    numbers[2] = viseme.blend;
    numbers[3] = expression.select1;
    numbers[4] = expression.intensity1;
    numbers[5] = expression.select2;
    numbers[6] = expression.intensity2;
    for (let fap = 3; fap <= fapCount; ++fap) this.frameFaps[fap] = levels[fap]! * steps[fap]!;
    this.exports.semblante_evaluate(this.at.rig, this.at.frame, this.poseAt(pose));
  }

  /** Interpolates linearly between poses a and b, `t` 0..1. `out` may be a or b. */
  interpolate(a: number, b: number, t: number, out: number): void {
    this.exports.semblante_interpolate(this.poseAt(a), this.poseAt(b), t, this.poseAt(out));
  }

  /**
   * Interpolates on a smooth curve through four poses, `spans` ms apart (0: that pose is absent); see semblante_ease.h.
   */
  ease(poses: readonly [number, number, number, number], spans: ArrayLike<number>, t: number, out: number): void {
    const [before, from, to, after] = poses;
    this.spans.set(spans);
    this.exports.semblante_ease(
      this.poseAt(before),
      this.poseAt(from),
      this.poseAt(to),
      this.poseAt(after),
      this.at.spans,
      t,
      this.poseAt(out),
    );
  }

  /** Deforms the mesh: Eq. 7, then eyes and tongue, then head. Writes `positions` and, if enabled, `normals`. */
  deform(pose: number): void {
    if (this.positions.length === 0) throw new RangeError('this kernel was created without vertices');
    const { face, positions, triangles, normals, shown } = this.at;
    const moved = this.exports.semblante_deform_changed(face, shown, this.poseAt(pose), positions);
    if (moved > 0 && triangles > 0) this.exports.semblante_normals(triangles, positions, normals);
    this.bytes.copyWithin(shown, this.poseAt(pose), this.poseAt(pose) + poseFloats * 4);
  }

  private poseAt(pose: number): number {
    const at = this.at.poses[pose];
    if (at === undefined) throw new RangeError(`unknown pose ${pose}`);
    return at;
  }
}

/** Prepares the face at address `face` for fast deformation; returns the address of the prepared face. */
function prepare(exports: KernelExports, face: number): number {
  const bytes = exports.semblante_prepared_size(face);
  if (bytes === 0) throw new FaceError('malformed', 'weights: feature points of a vertex are not increasing');
  return exports.semblante_prepare(face, alloc(exports, bytes));
}

function alloc(exports: KernelExports, bytes: number): number {
  const at = exports.semblante_alloc(bytes) >>> 0;
  if (at === 0) throw new FaceError('memory', `cannot allocate ${bytes} bytes for the kernel`);
  return at;
}

/** #sets by 84 by 3 */
export function flatten(sets: readonly DisplacementSet[]): Float32Array {
  const flat = new Float32Array(sets.length * featurePointCount * 3);
  sets.forEach((set, i) => {
    for (const [id, by] of Object.entries(set.displacements)) {
      flat.set(by, (i * featurePointCount + featurePointIndex(id)!) * 3);
    }
  });
  return flat;
}

/** The float members of semblante_lids in order. */
function lidNumbers(lids: RigLids | null): number[] {
  if (lids === null) return new Array<number>(lidFloats).fill(0);
  const { gaze, slit, opening, gaze_share, ball } = lids;
  return [...gaze, slit, opening, ...gaze_share, ...ball];
}

/** The float members of semblante_rig up to its companions, in order. A missing FAPU is 0. */
function rigNumbers(rig: RigDocument): number[] {
  const fapu = rigFapus.map((unit) => rig.fapu[unit] ?? 0);
  const irises = rig.irises.flatMap((iris) =>
    iris === null
      ? new Array<number>(irisFloats).fill(0)
      : [...iris.axis, iris.pupil_radius, iris.iris_radius, iris.bend],
  );
  const { tongue } = rig;
  const tongueNumbers =
    tongue === null
      ? new Array<number>(tongueFloats).fill(0)
      : [...tongue.origin, ...tongue.left, ...tongue.up, tongue.half_width, tongue.roll_limit];
  const pivots = [...rig.eye_pivots[0], ...rig.eye_pivots[1], ...rig.head_pivot];
  return [...fapu, ...pivots, rig.viseme_share, ...irises, ...tongueNumbers];
}

function poseViews(floats: Float32Array): Pose {
  let at = 0;
  const next = (count: number): Float32Array => floats.subarray(at, (at += count));
  return {
    featurePoints: next(featurePointCount * 3),
    eyeRotations: next(8),
    eyeTranslations: next(6),
    headRotation: next(4),
    eyePivots: next(6),
    headPivot: next(3),
    pupilGrowth: next(2),
    tongueRoll: next(1),
    irises: next(2 * irisFloats),
    tongue: next(tongueFloats),
    lidClosures: next(4),
    lids: next(2 * lidFloats),
  };
}

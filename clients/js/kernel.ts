import type { FaceFrame } from '../../protocol/ts/face_frame.ts';
import { featurePointCount } from '../../protocol/ts/generated/mpeg4.ts';
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
import { writeFrame } from './frames.ts';
import {
  companionLayout,
  faceLayout,
  frameLayout,
  irisLayout,
  lidsLayout,
  poseLayout,
  rigLayout,
  tongueLayout,
  trianglesLayout,
} from './generated/layouts.ts';
import { freeBlocks, type Runtime } from './runtime.ts';

// How many floats a struct holds. Of the rig: those before its first pointer after them.
const floatBytes = 4;
const rigFloats = (rigLayout.companion - rigLayout.fapu) / floatBytes;
const lidFloats = lidsLayout.bytes / floatBytes;
const irisFloats = irisLayout.bytes / floatBytes;
const tongueFloats = tongueLayout.bytes / floatBytes;
const poseFloats = poseLayout.bytes / floatBytes;

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
  lift: lidFloats - 1,
  count: lidFloats,
} as const;

/**
 * One face in the kernel: evaluates frames to poses (Eq. 5, 6) and poses to vertices (Eq. 7). Holds `poseCount` poses,
 * identified by number. All its memory is allocated at creation and freed by `dispose`.
 */
export class Kernel {
  private readonly runtime: Runtime;
  private readonly vertexCount: number;
  private readonly shareOfRig: number;
  private readonly release: () => void;
  /** views of the memory while its buffer is `buffer` */
  private views: { buffer: ArrayBufferLike; positions: Float32Array; normals: Float32Array; poses: Pose[] } | null = null;
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
    ownNormals: number;
    restNormals: number;
    poses: number[];
    /** address of the pose of the current `positions` */
    shown: number;
  };

  /**
   * `withVertices: false` omits the influence table, for deformation on the GPU: `deform` must not be called and
   * `positions` is empty. `withNormals: true` makes `deform` also compute `normals`, those of the mesh turned as its triangles turn, which takes
   * about as long as the vertices. Throws FaceError `memory` when the memory is exhausted.
   */
  constructor(runtime: Runtime, face: Face, options: KernelOptions = {}) {
    const exports = runtime.functions;
    this.runtime = runtime;
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
    const frame = place(frameLayout.bytes);
    const spans = place(12);
    const rigAt = place(rigLayout.bytes);
    const faceAt = place(faceLayout.bytes);
    const visemes = place(rig.visemes.length * featurePointCount * 12);
    const expressions = place(rig.expressions.length * featurePointCount * 12);
    const followers = [...rig.companions, ...rig.lower_lip];
    const companions = place(followers.length * companionLayout.bytes);
    const poses = Array.from({ length: options.poseCount ?? 3 }, () => place(poseLayout.bytes));
    const shown = place(poseLayout.bytes);
    const rest = place(vertices * 12);
    const positions = place(vertices * 12);
    const rowOffsets = place((vertices + 1) * 4);
    const rowPoints = place(entries);
    const rowWeights = place(entries * 4);
    const rigid = place(vertices);
    const turn = place(vertices);
    const trianglesAt = place(trianglesLayout.bytes);
    const cornersAt = place(corners * 4);
    const joined = place(turned * 4);
    const normals = place(turned * 12);
    const ownNormals = place(turned * 12);
    const restNormals = place(turned * 12);

    const base = runtime.alloc(size);
    const memory = exports.memory.buffer;
    const floats = (offset: number, count: number): Float32Array => new Float32Array(memory, base + offset, count);

    floats(visemes, rig.visemes.length * featurePointCount * 3).set(flatten(rig.visemes));
    floats(expressions, rig.expressions.length * featurePointCount * 3).set(flatten(rig.expressions));
    new Uint32Array(memory, base + rigAt + rigLayout.viseme, 2).set([base + visemes, base + expressions]);
    floats(rigAt + rigLayout.fapu, rigFloats).set(rigNumbers(rig));
    const companionView = new DataView(memory, base + companions, followers.length * companionLayout.bytes);
    followers.forEach(({ point, leader, share }, i) => {
      const at = i * companionLayout.bytes;
      companionView.setUint8(at + companionLayout.point, featurePointIndex(point)!);
      companionView.setUint8(at + companionLayout.leader, featurePointIndex(leader)!);
      companionView.setUint8(at + companionLayout.is_choice, i < rig.companions.length ? 0 : 1);
      companionView.setFloat32(at + companionLayout.share, share, true);
    });
    new Uint32Array(memory, base + rigAt + rigLayout.companion, 2).set([base + companions, followers.length]);
    floats(rigAt + rigLayout.lids, 2 * lidFloats).set(rig.lids.flatMap(lidNumbers));
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
      if (mesh.normals) floats(ownNormals, turned * 3).set(mesh.normals);
      new Uint32Array(memory, base + cornersAt, corners).set(mesh.triangles);
      const numbers = [turned, corners / 3, base + cornersAt, base + joined];
      new Uint32Array(memory, base + trianglesAt, 4).set(numbers);
    }
    let prepared: Prepared | null = null;
    try {
      if (vertices > 0) prepared = prepare(runtime, base + faceAt, base + rigAt);
      if (turned > 0) {
        const scratch = runtime.alloc(exports.semblante_join_scratch(turned) * 4);
        exports.semblante_join_seams(turned, base + rest, base + ownNormals, scratch, base + joined);
        runtime.free(scratch);
        exports.semblante_rest_normals(base + trianglesAt, base + rest, base + ownNormals, base + restNormals);
        runtime.bytes.copyWithin(base + normals, base + ownNormals, base + ownNormals + turned * 12); // the memory may have grown
      }
    } catch (error) {
      runtime.free(base);
      if (prepared) runtime.free(prepared.memory);
      throw error;
    }
    this.release = runtime.owns(this, freeBlocks, { runtime, blocks: [base, prepared?.memory ?? 0] });

    this.at = {
      frame: base + frame,
      spans: base + spans,
      rig: base + rigAt,
      face: prepared?.face ?? 0,
      positions: base + positions,
      triangles: turned > 0 ? base + trianglesAt : 0,
      normals: base + normals,
      ownNormals: base + ownNormals,
      restNormals: base + restNormals,
      poses: poses.map((offset) => base + offset),
      shown: base + shown,
    };
    this.vertexCount = vertices;
    this.shareOfRig = rig.viseme_share;
    for (const pose of [...this.at.poses, this.at.shown]) exports.semblante_evaluate(this.at.rig, this.at.frame, pose);
  }

  /** Frees the memory; the kernel must not be used afterwards. */
  dispose(): void {
    this.release();
  }

  /**
   * #V by 3: output of `deform`. Read only: `deform` updates only the vertices that changed since the last call. Ask for it
   * again after anything was created: the array is empty when the memory has grown.
   */
  get positions(): Float32Array {
    return this.current().positions;
  }

  /** #V by 3, unit length: the normals of `positions`. Empty without the option `withNormals`. */
  get normals(): Float32Array {
    return this.current().normals;
  }

  get poses(): readonly Pose[] {
    return this.current().poses;
  }

  private current(): NonNullable<Kernel['views']> {
    const { buffer } = this.runtime.functions.memory;
    if (this.views?.buffer !== buffer) {
      const { positions, normals, poses, triangles } = this.at;
      const floats = (at: number, count: number): Float32Array => new Float32Array(buffer, at, count);
      this.views = {
        buffer,
        positions: floats(positions, this.vertexCount * 3),
        normals: floats(normals, triangles > 0 ? this.vertexCount * 3 : 0),
        poses: poses.map((at) => poseViews(floats(at, poseFloats))),
      };
    }
    return this.views;
  }

  /**
   * Sets the viseme share of Eq. 5 (the weight of the viseme where an expression moves the same feature point, 0..1)
   * for later calls of `evaluate`; null: the rig's own. Throws RangeError.
   */
  setVisemeShare(share: number | null): void {
    if (share !== null && !(share >= 0 && share <= 1)) throw new RangeError('a viseme share must be between 0 and 1');
    this.runtime.view.setFloat32(this.at.rig + rigLayout.viseme_share, share ?? this.shareOfRig, true);
  }

  /**
   * Whether FAP 3 alone takes the lower lip along, for later calls of `evaluate`. By the standard it does not (false,
   * the default): streams move the lip by FAPs of its own, and these always win.
   */
  setJawTakesLip(takes: boolean): void {
    this.runtime.view.setFloat32(this.at.rig + rigLayout.lip_share, takes ? 1 : 0, true);
  }

  /**
   * Evaluates a frame to a pose (Eq. 5, 6). `steps`: the quantizer steps of the frame's stream, FAP units per level.
   */
  evaluate(frame: FaceFrame, pose: number, steps: QuantizerSteps = standardQuantizers): void {
    writeFrame(this.runtime.view, this.at.frame, frame, steps);
    this.evaluateAt(this.runtime, this.at.frame, pose);
  }

  /** Evaluates a semblante_frame by its address. Throws RangeError unless `runtime` is the library of this kernel. */
  evaluateAt(runtime: Runtime, frame: number, pose: number): void {
    if (runtime !== this.runtime) throw new RangeError('the frame lies in the memory of another instance of the library');
    runtime.functions.semblante_evaluate(this.at.rig, frame, this.poseAt(pose));
  }

  /** Interpolates linearly between poses a and b, `t` 0..1. `out` may be a or b. */
  interpolate(a: number, b: number, t: number, out: number): void {
    this.runtime.functions.semblante_interpolate(this.poseAt(a), this.poseAt(b), t, this.poseAt(out));
  }

  /**
   * Interpolates on a smooth curve through four poses, `spans` ms apart (0: that pose is absent); see semblante_ease.h.
   */
  ease(poses: readonly [number, number, number, number], spans: ArrayLike<number>, t: number, out: number): void {
    const [before, from, to, after] = poses;
    for (let i = 0; i < 3; i += 1) this.runtime.view.setFloat32(this.at.spans + i * 4, spans[i]!, true);
    this.runtime.functions.semblante_ease(
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
    if (this.vertexCount === 0) throw new RangeError('this kernel was created without vertices');
    const { face, positions, triangles, normals, ownNormals, restNormals, shown } = this.at;
    const { functions } = this.runtime;
    const moved = functions.semblante_deform_changed(face, shown, this.poseAt(pose), positions);
    if (moved > 0 && triangles > 0) {
      functions.semblante_normals(triangles, positions, normals);
      functions.semblante_turn_normals(this.vertexCount, ownNormals, restNormals, normals);
    }
    this.runtime.bytes.copyWithin(shown, this.poseAt(pose), this.poseAt(pose) + poseLayout.bytes);
  }

  private poseAt(pose: number): number {
    const at = this.at.poses[pose];
    if (at === undefined) throw new RangeError(`unknown pose ${pose}`);
    return at;
  }
}

interface Prepared {
  memory: number;
  /** address of semblante_prepared_face */
  face: number;
}

/** Prepares the face at address `face` for fast deformation by poses of the rig at address `rig`. */
function prepare(runtime: Runtime, face: number, rig: number): Prepared {
  const bytes = runtime.functions.semblante_prepared_size(face);
  if (bytes === 0) throw new FaceError('malformed', 'weights: feature points of a vertex are not increasing');
  const memory = runtime.alloc(bytes);
  return { memory, face: runtime.functions.semblante_prepare_for(face, rig, memory) };
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
  const { gaze, slit, opening, gaze_share, ball, lift = 0 } = lids;
  return [...gaze, slit, opening, ...gaze_share, ...ball, lift];
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

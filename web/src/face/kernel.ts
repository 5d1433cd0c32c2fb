import type { FaceFrame } from './frame.ts';
import type { FaceMesh } from './mesh.ts';
import { poseAt, poseBytes, type Pose } from './pose.ts';

/** What core/kernel/semblante_kernel.h exports; pointers are byte offsets into `memory`. */
interface KernelExports {
  memory: WebAssembly.Memory;
  semblante_alloc(bytes: number): number;
  semblante_evaluate(rig: number, frame: number, pose: number): void;
  semblante_interpolate(a: number, b: number, t: number, out: number): void;
  semblante_deform(face: number, pose: number, positions: number): void;
}

/** What Eq. 5 and 6 need of one model, in model units. */
export interface RigData {
  /** 15 by 84 by 3 */
  visemes: Float32Array;
  /** 7 by 84 by 3, the first set all zero */
  expressions: Float32Array;
  /** IRISD, ES, ENS, MNS, MW, divided by 1024; 0 where unknown */
  fapu: readonly [number, number, number, number, number];
  eyePivots: readonly [readonly number[], readonly number[]];
  headPivot: readonly number[];
  visemeShare: number;
}

const frameBytes = 8 + 69 * 4;
const rigBytes = 4 + 4 + (5 + 6 + 3 + 1) * 4;
const faceBytes = 6 * 4;
const spareForPoses = 64;

/**
 * The C kernel as WebAssembly, with the tables of one face in its memory. All memory is taken at construction, so the
 * views stay valid and no call allocates.
 */
export class Kernel {
  private readonly code: KernelExports;
  private readonly rig: number;
  private readonly frame: number;
  private readonly face: number;
  private readonly positionsAt: number;
  private readonly positions: Float32Array;
  private readonly frameBytesView: Uint8Array;
  private readonly frameFloats: Float32Array;
  private readonly placeOf = new WeakMap<Pose, number>();
  private readonly poses: Pose[] = [];
  private posesGiven = 0;

  private constructor(code: KernelExports, mesh: FaceMesh, rig: RigData) {
    this.code = code;
    const entries = mesh.rowPoints.length;
    const take = (bytes: number): number => {
      const at = code.semblante_alloc(bytes);
      if (at === 0) throw new RangeError('the browser gives no memory for this face');
      return at;
    };
    const visemes = take(15 * 84 * 3 * 4);
    const expressions = take(7 * 84 * 3 * 4);
    this.rig = take(rigBytes);
    this.frame = take(frameBytes);
    this.face = take(faceBytes);
    const rest = take(mesh.vertexCount * 12);
    const rowOffsets = take((mesh.vertexCount + 1) * 4);
    const rowPoints = take(Math.max(entries, 1));
    const rowWeights = take(Math.max(entries, 1) * 4);
    const rigid = take(Math.max(mesh.vertexCount, 1));
    this.positionsAt = take(mesh.vertexCount * 12);
    const posePlaces = Array.from({ length: spareForPoses }, () => take(poseBytes));

    // Only now does the memory stay where it is.
    const { buffer } = code.memory;
    new Float32Array(buffer, visemes, rig.visemes.length).set(rig.visemes);
    new Float32Array(buffer, expressions, rig.expressions.length).set(rig.expressions);
    new Uint32Array(buffer, this.rig, 2).set([visemes, expressions]);
    new Float32Array(buffer, this.rig + 8, 15).set([...rig.fapu, ...rig.eyePivots[0], ...rig.eyePivots[1], ...rig.headPivot, rig.visemeShare]);
    new Float32Array(buffer, rest, mesh.positions.length).set(mesh.positions);
    new Uint32Array(buffer, rowOffsets, mesh.rowOffsets.length).set(mesh.rowOffsets);
    new Uint8Array(buffer, rowPoints, entries).set(mesh.rowPoints);
    new Float32Array(buffer, rowWeights, entries).set(mesh.rowWeights);
    new Uint8Array(buffer, rigid, mesh.rigid.length).set(mesh.rigid);
    new Uint32Array(buffer, this.face, 6).set([mesh.vertexCount, rest, rowOffsets, rowPoints, rowWeights, rigid]);
    this.positions = new Float32Array(buffer, this.positionsAt, mesh.vertexCount * 3);
    this.frameBytesView = new Uint8Array(buffer, this.frame, 8);
    this.frameFloats = new Float32Array(buffer, this.frame + 8, 69);
    for (const place of posePlaces) {
      const pose = poseAt(buffer, place);
      this.placeOf.set(pose, place);
      this.poses.push(pose);
    }
  }

  static async create(module: WebAssembly.Module, mesh: FaceMesh, rig: RigData): Promise<Kernel> {
    const instance = await WebAssembly.instantiate(module, {});
    return new Kernel(instance.exports as unknown as KernelExports, mesh, rig);
  }

  /** A neutral pose in the kernel's memory. There are only a few: ask once, keep it. */
  newPose(): Pose {
    const pose = this.poses[this.posesGiven];
    if (!pose) throw new RangeError('no more poses');
    this.posesGiven += 1;
    this.frameBytesView.fill(0);
    this.frameFloats.fill(0);
    this.code.semblante_evaluate(this.rig, this.frame, this.at(pose));
    return pose;
  }

  /** Frame -> pose (Eq. 5, 6). */
  evaluate(frame: FaceFrame, out: Pose): void {
    const bytes = this.frameBytesView;
    bytes[0] = frame.viseme.select1;
    bytes[1] = frame.viseme.select2;
    bytes[2] = frame.viseme.blend;
    bytes[3] = frame.expression.select1;
    bytes[4] = frame.expression.intensity1;
    bytes[5] = frame.expression.select2;
    bytes[6] = frame.expression.intensity2;
    bytes[7] = 0;
    this.frameFloats.set(frame.faps);
    this.code.semblante_evaluate(this.rig, this.frame, this.at(out));
  }

  /** The pose `t` of the way from `a` to `b`; `out` may be either. */
  interpolate(a: Pose, b: Pose, t: number, out: Pose): void {
    this.code.semblante_interpolate(this.at(a), this.at(b), t, this.at(out));
  }

  /** Pose -> vertices (Eq. 7, then eyes, then head), #V by 3: the same array each time. */
  deform(pose: Pose): Float32Array {
    this.code.semblante_deform(this.face, this.at(pose), this.positionsAt);
    return this.positions;
  }

  private at(pose: Pose): number {
    const place = this.placeOf.get(pose);
    if (place === undefined) throw new TypeError('this pose belongs to another face');
    return place;
  }
}

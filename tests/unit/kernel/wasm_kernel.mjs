// The kernel's WebAssembly module with its structs laid out by hand, as any JavaScript client does it.
// Offsets are those of semblante_kernel.h on a machine with 32-bit pointers.
const FP = 84;
const POSE_BYTES = 1436;

export class WasmKernel {
  constructor(bytes) {
    this.exports = new WebAssembly.Instance(new WebAssembly.Module(bytes), {}).exports;
  }

  alloc(bytes) {
    const at = this.exports.semblante_alloc(bytes);
    if (at === 0) throw new Error(`no memory for ${bytes} bytes`);
    return at;
  }

  floats(values) {
    const at = this.alloc(values.length * 4);
    new Float32Array(this.exports.memory.buffer, at, values.length).set(values);
    return at;
  }

  view() {
    return new DataView(this.exports.memory.buffer); // made anew: growth detaches the old one
  }

  rig({ fapu, eye_pivot, head_pivot, viseme_share, visemes, expressions, ...parts }) {
    const { irises = [null, null], tongue = null, lids = [null, null], companions = [], lower_lip = [] } = parts;
    const table = (sets) => {
      const all = new Float32Array(sets.length * FP * 3);
      sets.forEach((set, s) => {
        for (const [fp, d] of Object.entries(set)) all.set(d, (s * FP + Number(fp)) * 3);
      });
      return this.floats(all);
    };
    const viseme = table(visemes);
    const expression = table(expressions);
    const followers = [...companions, ...lower_lip];
    const followersAt = this.alloc(followers.length * 8);
    const at = this.alloc(372);
    const view = this.view();
    followers.forEach(([point, leader, share], i) => {
      [point, leader, i < companions.length ? 0 : 1, 0].forEach((b, k) => view.setUint8(followersAt + 8 * i + k, b));
      view.setFloat32(followersAt + 8 * i + 4, share, true);
    });
    view.setUint32(at, viseme, true);
    view.setUint32(at + 4, expression, true);
    const numbers = [...fapu, ...eye_pivot.flat(), ...head_pivot, viseme_share];
    for (const iris of irises) {
      numbers.push(...(iris ? [...iris.axis, iris.pupil_radius, iris.iris_radius, iris.bend] : new Array(6).fill(0)));
    }
    numbers.push(...(tongue ? [...tongue.origin, ...tongue.left, ...tongue.up] : new Array(9).fill(0)));
    numbers.push(tongue?.half_width ?? 0, tongue?.roll_limit ?? 0);
    numbers.forEach((x, i) => view.setFloat32(at + 8 + 4 * i, x, true));
    view.setUint32(at + 160, followersAt, true);
    view.setUint32(at + 164, followers.length, true);
    this.setLipShare(at, 0);
    const lidNumbers = lids.flatMap((l) =>
      l
        ? [...l.gaze, l.slit, l.opening, ...l.gaze_share, ...l.ball, l.lift ?? 0]
        : new Array(25).fill(0),
    );
    lidNumbers.forEach((x, i) => view.setFloat32(at + 172 + 4 * i, x, true));
    return at;
  }

  /** Whether FAP 3 alone takes the lower lip along: 0 or 1. */
  setLipShare(rig, share) {
    this.view().setFloat32(rig + 168, share, true);
  }

  frame({ viseme, expression, faps }) {
    const at = this.alloc(284);
    const view = this.view();
    const bytes = [viseme.select1, viseme.select2, viseme.blend];
    bytes.push(expression.select1, expression.intensity1, expression.select2, expression.intensity2, 0);
    bytes.forEach((b, i) => view.setUint8(at + i, b));
    for (let n = 0; n <= 68; ++n) view.setFloat32(at + 8 + 4 * n, faps[n] ?? 0, true);
    return at;
  }

  face({ rest, rows, rigid, turn = null }) {
    const restAt = this.floats(rest.flat());
    const entries = rows.flat();
    const offsetsAt = this.alloc(4 * (rows.length + 1));
    const pointsAt = this.alloc(entries.length);
    const weightsAt = this.floats(entries.map((e) => e[1]));
    const rigidAt = this.alloc(rigid.length);
    const turnAt = turn ? this.alloc(turn.length) : 0;
    const memory = this.exports.memory.buffer;
    const offsets = new Uint32Array(memory, offsetsAt, rows.length + 1);
    rows.forEach((row, v) => (offsets[v + 1] = offsets[v] + row.length));
    new Uint8Array(memory, pointsAt, entries.length).set(entries.map((e) => e[0]));
    new Uint8Array(memory, rigidAt, rigid.length).set(rigid);
    if (turn) new Uint8Array(memory, turnAt, turn.length).set(turn);
    const at = this.alloc(28);
    const view = this.view();
    [rest.length, restAt, offsetsAt, pointsAt, weightsAt, rigidAt, turnAt].forEach((x, i) => view.setUint32(at + 4 * i, x, true));
    return at;
  }

  evaluate(rig, frame) {
    const pose = this.alloc(POSE_BYTES);
    this.exports.semblante_evaluate(rig, frame, pose);
    return pose;
  }

  interpolate(a, b, t) {
    const pose = this.alloc(POSE_BYTES);
    this.exports.semblante_interpolate(a, b, t, pose);
    return pose;
  }

  displacements(pose) {
    return new Float32Array(this.exports.memory.buffer, pose, FP * 3).slice();
  }

  deform(face, pose) {
    const count = this.view().getUint32(face, true);
    const at = this.alloc(count * 12);
    this.exports.semblante_deform(face, pose, at);
    return new Float32Array(this.exports.memory.buffer, at, count * 3).slice();
  }

  /** What semblante_deform_prepared gives. */
  deformPrepared(face, pose) {
    const { semblante_prepared_size, semblante_prepare, semblante_deform_prepared, memory } = this.exports;
    const prepared = semblante_prepare(face, this.alloc(semblante_prepared_size(face)));
    const count = this.view().getUint32(face, true);
    const at = this.alloc(count * 12);
    semblante_deform_prepared(prepared, pose, at);
    return new Float32Array(memory.buffer, at, count * 3).slice();
  }

  /** A semblante_triangles with seams joined. */
  triangles({ rest, normals, triangles }) {
    const { semblante_join_scratch, semblante_join_seams, memory } = this.exports;
    const restAt = this.floats(rest.flat());
    const normalsAt = this.floats(normals.flat());
    const cornersAt = this.alloc(triangles.length * 12);
    const joinedAt = this.alloc(rest.length * 4);
    const scratchAt = this.alloc(semblante_join_scratch(rest.length) * 4);
    new Uint32Array(memory.buffer, cornersAt, triangles.length * 3).set(triangles.flat());
    semblante_join_seams(rest.length, restAt, normalsAt, scratchAt, joinedAt);
    const at = this.alloc(16);
    new Uint32Array(memory.buffer, at, 4).set([rest.length, triangles.length, cornersAt, joinedAt]);
    const atRest = this.alloc(rest.length * 12);
    this.exports.semblante_rest_normals(at, restAt, normalsAt, atRest);
    return { at, own: normalsAt, atRest };
  }

  normals(triangles, positions) {
    const positionsAt = this.floats(positions);
    const at = this.alloc(positions.length * 4);
    this.exports.semblante_normals(triangles.at, positionsAt, at);
    this.exports.semblante_turn_normals(positions.length / 3, triangles.own, triangles.atRest, at);
    return new Float32Array(this.exports.memory.buffer, at, positions.length).slice();
  }
}

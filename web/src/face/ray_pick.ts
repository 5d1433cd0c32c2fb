/** A ray: origin and direction, x y z each. */
export type Ray = Float64Array;

/**
 * The vertex nearest to where a ray first meets a mesh, or -1: of the triangle that it meets, the corner with the largest
 * barycentric coordinate. `positions`: #V by 3. Front and back faces count. Allocates nothing.
 */
export function pickVertex(positions: Float32Array, indices: Uint32Array, ray: Ray): number {
  const [ox, oy, oz, dx, dy, dz] = [ray[0]!, ray[1]!, ray[2]!, ray[3]!, ray[4]!, ray[5]!];
  let nearest = Infinity;
  let vertex = -1;
  for (let i = 0; i + 2 < indices.length; i += 3) {
    const a = indices[i]! * 3;
    const b = indices[i + 1]! * 3;
    const c = indices[i + 2]! * 3;
    const ax = positions[a]!;
    const ay = positions[a + 1]!;
    const az = positions[a + 2]!;
    const ux = positions[b]! - ax;
    const uy = positions[b + 1]! - ay;
    const uz = positions[b + 2]! - az;
    const vx = positions[c]! - ax;
    const vy = positions[c + 1]! - ay;
    const vz = positions[c + 2]! - az;
    // Möller and Trumbore: the determinant is zero for a triangle along the ray or without area.
    const px = dy * vz - dz * vy;
    const py = dz * vx - dx * vz;
    const pz = dx * vy - dy * vx;
    const determinant = ux * px + uy * py + uz * pz;
    if (determinant === 0) continue;
    const tx = ox - ax;
    const ty = oy - ay;
    const tz = oz - az;
    const s = (tx * px + ty * py + tz * pz) / determinant;
    if (!(s >= 0 && s <= 1)) continue;
    const qx = ty * uz - tz * uy;
    const qy = tz * ux - tx * uz;
    const qz = tx * uy - ty * ux;
    const t = (dx * qx + dy * qy + dz * qz) / determinant;
    if (!(t >= 0 && s + t <= 1)) continue;
    const distance = (vx * qx + vy * qy + vz * qz) / determinant;
    if (!(distance > 0 && distance < nearest)) continue;
    nearest = distance;
    const first = 1 - s - t;
    vertex = first >= s && first >= t ? indices[i]! : s >= t ? indices[i + 1]! : indices[i + 2]!;
  }
  return vertex;
}

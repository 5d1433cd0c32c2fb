import {
  BufferGeometry,
  Group,
  Mesh,
  Raycaster,
  Triangle,
  Vector2,
  Vector3,
  type BufferAttribute,
  type Camera,
  type Intersection,
  type Material,
  type Object3D,
} from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { makeSolidPart } from '@client/three/solid_part.ts';
import { defaultMaterial, studioMaterial } from '@client/three/studio_material.ts';
import type { PartRole } from '@protocol/rig_document.ts';
import { disposeMaterials } from './dispose_materials.ts';
import { pickThrough, type Meeting } from './pick_through.ts';
import { framedHead, type Box, type Piece } from './head_box.ts';
import { meantCorner, moveToEdge } from './triangle_place.ts';
import { outwardAt } from './outward.ts';

/** A place on the surface: a vertex of the file, by number, or a place between vertices, with null. */
export interface SurfacePlace {
  vertex: number | null;
  position: [number, number, number];
}

/** A picked place on the mesh: the vertex nearest to it. */
export interface Pick {
  fileVertex: number;
  position: [number, number, number];
  /** Part index, or null for a model imported by a version that did not store parts. */
  part: number | null;
  /** Where the surface itself is hit. */
  hit: [number, number, number];
  /** The place of a point that is set there: `hit`, unless a vertex or an edge is meant (triangle_place.ts). */
  place: SurfacePlace;
}

/** The vertices of all meshes, in the scene's space. `parts`: -1 where the model does not tell. */
interface VertexTable {
  positions: Float32Array;
  normals: Float32Array;
  /** Numbers of the file's vertices. */
  numbers: Int32Array;
  parts: Int32Array;
  /** Three per triangle. */
  corners: Uint32Array;
}

/** The parts that a pick is meant for. */
export interface Meant {
  roles: readonly PartRole[];
  /** The role of a part by its index. */
  roleOf: (part: number) => PartRole | null;
  /** How far behind the first surface they may lie, model units. */
  depth: number;
}


/** The imported model: still, with its materials, and with the file's vertex number of every vertex. */
export class PreviewView {
  readonly object = new Group();
  private readonly meshes: Mesh[] = [];
  private readonly solidParts: Mesh[] = [];
  private readonly raycaster = new Raycaster();
  private readonly pointer = new Vector2();
  private table: VertexTable | null = null;
  private positionOfFileVertex: Map<number, Vector3> | null = null;

  private constructor(
    scene: Object3D,
    /** Indexed by the material's number in the file. */
    readonly materials: Material[],
  ) {
    this.object.add(scene);
    this.object.updateMatrixWorld(true);
    scene.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      node.castShadow = true;
      node.receiveShadow = true;
      if (!node.geometry.getAttribute('normal')) node.geometry.computeVertexNormals();
      this.meshes.push(node);
    });
    for (const mesh of this.meshes) {
      const solid = makeSolidPart(mesh);
      if (!solid) continue;
      solid.receiveShadow = true;
      mesh.add(solid);
      this.solidParts.push(solid);
    }
  }

  static async load(bytes: Uint8Array, richSkin: boolean): Promise<PreviewView> {
    const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) as ArrayBuffer;
    const gltf = await new GLTFLoader().parseAsync(buffer, '');
    const polished = new Map<Material, Material>();
    const numbered: Material[] = [];
    gltf.scene.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      const raw = node.material as Material;
      let material = polished.get(raw);
      if (!material) {
        material =
          raw.name === '' && !gltf.parser.associations.has(raw)
            ? defaultMaterial(richSkin)
            : studioMaterial(raw, richSkin);
        polished.set(raw, material);
      }
      node.material = material;
      const number = gltf.parser.associations.get(raw)?.materials;
      if (number !== undefined) numbered[number] = material;
    });
    for (let i = 0; i < numbered.length; i += 1) numbered[i] ??= defaultMaterial(richSkin);
    return new PreviewView(gltf.scene, numbered);
  }

  set wireframe(on: boolean) {
    for (const mesh of [...this.meshes, ...this.solidParts])
      if ('wireframe' in (mesh.material as object)) (mesh.material as unknown as { wireframe: boolean }).wireframe = on;
  }

  /** Draws and picks the other parts only. */
  hide(parts: ReadonlySet<number>): void {
    for (const { geometry } of this.meshes) {
      const { index } = geometry;
      if (!index || !geometry.hasAttribute('_part')) continue;
      // All triangles stay in the index: those that are seen come first, and the range of what is drawn ends behind them.
      const seen = cornersOf(geometry, (part) => !parts.has(part));
      if (seen.length < index.count || geometry.drawRange.count < index.count) {
        index.array.set([...seen, ...cornersOf(geometry, (part) => parts.has(part))]);
        index.needsUpdate = true;
        geometry.setDrawRange(0, seen.length);
      }
    }
  }

  /** The box of the head, with room below the chin, where it is a part of a body or a bust; otherwise null. `roleOf`: see Meant. */
  head(roleOf: Meant['roleOf']): Box | null {
    const eyes: Record<'left_eye' | 'right_eye', number[]> = { left_eye: [], right_eye: [] };
    const pieces = this.meshes.map(({ geometry, matrixWorld }) => {
      const placed = geometry.getAttribute('position').clone().applyMatrix4(matrixWorld);
      const positions = Float32Array.from({ length: placed.count * 3 }, (_, i) => placed.getComponent(Math.floor(i / 3), i % 3));
      for (let i = 0; i < placed.count && geometry.hasAttribute('_part'); i += 1) {
        const role = roleOf(partOf(geometry, i));
        if (role === 'left_eye' || role === 'right_eye') eyes[role].push(...positions.subarray(i * 3, i * 3 + 3));
      }
      const triangles = geometry.index?.array ?? Uint32Array.from({ length: placed.count }, (_, i) => i);
      return { positions, triangles };
    });
    const ball = (positions: number[]): Piece => ({ positions, triangles: [] });
    const hasEyes = eyes.left_eye.length > 0 && eyes.right_eye.length > 0;
    return framedHead(pieces, hasEyes ? [ball(eyes.left_eye), ball(eyes.right_eye)] : null);
  }

  /**
   * `x`, `y`: normalized device coordinates, -1..1 from the lower left. `meant`: the parts that are meant, behind others too;
   * without it the first surface is.
   */
  pick(x: number, y: number, camera: Camera, meant: Meant | null = null): Pick | null {
    this.raycaster.setFromCamera(this.pointer.set(x, y), camera);
    const hits = this.raycaster.intersectObjects(this.meshes, false);
    const hit = hits[meant ? pickThrough(hits.map((one) => this.meeting(one, meant)), meant.roles, meant.depth) : 0];
    if (!hit?.face) return null;
    const mesh = hit.object as Mesh;
    const position = mesh.geometry.getAttribute('position') as BufferAttribute;
    const vertices = [hit.face.a, hit.face.b, hit.face.c] as const;
    const places = [triangle.a, triangle.b, triangle.c] as const;
    places.forEach((place, k) => place.fromBufferAttribute(position, vertices[k]!).applyMatrix4(mesh.matrixWorld));
    const away = places.map((place) => place.distanceTo(hit.point));
    const best = away.indexOf(Math.min(...away));
    return {
      fileVertex: fileVertexOf(mesh.geometry, vertices[best]!),
      part: mesh.geometry.hasAttribute('_part') ? partOf(mesh.geometry, vertices[best]!) : null,
      position: places[best]!.toArray(),
      hit: hit.point.toArray(),
      place: placeOn(hit.point, triangle, (k) => fileVertexOf(mesh.geometry, vertices[k]!)),
    };
  }

  /**
   * The place nearest to the mirror image of a place, `middle` being the x of the plane, on the parts that qualify and within
   * `reach`; null: none. A vertex stands for its surroundings within a tenth of `reach` if the place is a vertex. Where two rims
   * touch, the normals tell which of them is meant.
   */
  mirrored({ vertex, position }: SurfacePlace, middle: number, reach: number, qualifies: (part: number) => boolean): SurfacePlace | null {
    const { positions, normals, numbers, parts, corners } = (this.table ??= tableOf(this.meshes));
    const from = (vertex === null ? nearestOf(positions, position) : numbers.indexOf(vertex)) * 3;
    if (from < 0) return null;
    const [px, py, pz] = vertex === null ? position : [positions[from]!, positions[from + 1]!, positions[from + 2]!];
    const image = corner.set(2 * middle - px, py, pz);
    const turn = (reach * 0.05) ** 2; // what a normal of the other side counts, squared model units
    let best = -1;
    let least = Infinity;
    for (let t = 0; t < corners.length; t += 3) {
      const a = corners[t]! * 3;
      const room = Math.min(reach, Math.sqrt(least));
      if (beyond(image, positions, a, corners[t + 1]! * 3, corners[t + 2]! * 3) > room || !qualifies(parts[corners[t]!]!)) continue;
      const distance = corneredBy(positions, corners, t).closestPointToPoint(image, nearest).distanceToSquared(image);
      if (distance >= least || distance > reach * reach) continue;
      const alike = normals[a + 1]! * normals[from + 1]! + normals[a + 2]! * normals[from + 2]! - normals[a]! * normals[from]!;
      const cost = distance + turn * (1 - alike);
      if (cost >= least) continue;
      least = cost;
      best = t;
    }
    if (best < 0) return null;
    corneredBy(positions, corners, best).closestPointToPoint(image, nearest);
    const numberOf = (k: number): number => numbers[corners[best + k]!]!;
    if (vertex !== null) {
      const places = [triangle.a, triangle.b, triangle.c];
      const near = places.findIndex((place) => place.distanceTo(nearest) <= reach * 0.1);
      if (near >= 0) return { vertex: numberOf(near), position: places[near]!.toArray() };
    }
    return placeOn(nearest, triangle, numberOf);
  }

  private meeting({ object, face, distance }: Intersection, { roleOf }: Meant): Meeting {
    const { geometry } = object as Mesh;
    const part = face && geometry.hasAttribute('_part') ? partOf(geometry, face.a) : null;
    // The normals of the vertices, since files turn triangles as they like.
    const outside = face
      ? corner.fromBufferAttribute(geometry.getAttribute('normal') as BufferAttribute, face.a).dot(this.raycaster.ray.direction) < 0
      : false;
    return { distance, role: part === null ? null : roleOf(part), outside };
  }

  /** The triangles of a part, one geometry per mesh that has any; they share the preview's vertex buffers. */
  geometriesOf(part: number): BufferGeometry[] {
    const found: BufferGeometry[] = [];
    for (const { geometry } of this.meshes) {
      const corners = cornersOf(geometry, (one) => one === part);
      if (corners.length === 0) continue;
      const piece = new BufferGeometry();
      piece.setAttribute('position', geometry.getAttribute('position'));
      piece.setIndex(corners);
      found.push(piece);
    }
    return found;
  }

  /** The triangles of these parts alone, with their materials, as an object of its own; `release` ends it. */
  only(parts: ReadonlySet<number>): Group {
    const group = new Group();
    for (const mesh of this.meshes) {
      const { geometry } = mesh;
      const corners = cornersOf(geometry, (part) => parts.has(part));
      if (corners.length === 0) continue;
      const piece = new BufferGeometry();
      for (const [name, attribute] of Object.entries(geometry.attributes)) piece.setAttribute(name, attribute);
      piece.setIndex(corners);
      const copy = new Mesh(piece, mesh.material);
      copy.receiveShadow = true;
      copy.matrixAutoUpdate = false;
      copy.matrix.copy(mesh.matrixWorld);
      group.add(copy);
    }
    return group;
  }

  release(group: Object3D): void {
    group.removeFromParent();
    for (const { geometry } of group.children as Mesh[]) {
      // The vertex buffers are the preview's, which must not be disposed with it.
      for (const name of Object.keys(geometry.attributes)) geometry.deleteAttribute(name);
      geometry.dispose();
    }
  }

  /** The mean normal at these vertices of the file; zero where the normals cancel out. */
  normalAt(fileVertices: readonly number[]): Vector3 {
    const wanted = new Set(fileVertices);
    const sum = new Vector3();
    let count = 0;
    for (const { geometry } of this.meshes) {
      const normal = geometry.getAttribute('normal');
      for (let v = 0; v < normal.count; v += 1) {
        if (!wanted.has(fileVertexOf(geometry, v))) continue;
        sum.add(corner.fromBufferAttribute(normal, v));
        count += 1;
      }
    }
    return count > 0 ? sum.divideScalar(count) : sum;
  }

  /** Where the skin about a place of the surface looks; see `outwardAt`. */
  outwardAt(place: Vector3, radius: number): Vector3 {
    return outwardAt(
      this.meshes.map(({ geometry }) => ({ positions: geometry.getAttribute('position'), normals: geometry.getAttribute('normal') })),
      place,
      radius,
    );
  }

  /** The position of a vertex of the file, or null if no triangle uses it. */
  positionOf(fileVertex: number): Vector3 | null {
    if (!this.positionOfFileVertex) {
      this.positionOfFileVertex = new Map();
      for (const mesh of this.meshes) {
        const position = mesh.geometry.getAttribute('position') as BufferAttribute;
        for (let v = 0; v < position.count; v += 1) {
          const number = fileVertexOf(mesh.geometry, v);
          if (this.positionOfFileVertex.has(number)) continue;
          this.positionOfFileVertex.set(
            number,
            new Vector3().fromBufferAttribute(position, v).applyMatrix4(mesh.matrixWorld),
          );
        }
      }
    }
    return this.positionOfFileVertex.get(fileVertex) ?? null;
  }

  dispose(): void {
    this.object.removeFromParent();
    for (const mesh of this.meshes) mesh.geometry.dispose();
    const drawn = [...this.meshes, ...this.solidParts].map((mesh) => mesh.material as Material);
    disposeMaterials(new Set([...this.materials, ...drawn]));
  }
}

const corner = new Vector3();
const nearest = new Vector3();
const triangle = new Triangle();

/** The place of a point that is set at a place of a triangle; `numberOf`: the vertex of the file at a corner, 0 to 2. */
function placeOn(place: Vector3, on: Triangle, numberOf: (corner: number) => number): SurfacePlace {
  const meant = meantCorner(place, on);
  if (meant >= 0) return { vertex: numberOf(meant), position: [on.a, on.b, on.c][meant]!.toArray() };
  return { vertex: null, position: moveToEdge(corner.copy(place), on).toArray() };
}

/** The triangle whose corners start at `t`. */
function corneredBy(positions: Float32Array, corners: Uint32Array, t: number): Triangle {
  triangle.a.fromArray(positions, corners[t]! * 3);
  triangle.b.fromArray(positions, corners[t + 1]! * 3);
  triangle.c.fromArray(positions, corners[t + 2]! * 3);
  return triangle;
}

/** How far a place is outside of the box of a triangle, along one axis. */
function beyond(place: Vector3, positions: Float32Array, a: number, b: number, c: number): number {
  let most = 0;
  for (let axis = 0; axis < 3; axis += 1) {
    const [p, q, r] = [positions[a + axis]!, positions[b + axis]!, positions[c + axis]!];
    const at = axis === 0 ? place.x : axis === 1 ? place.y : place.z;
    most = Math.max(most, Math.min(p, q, r) - at, at - Math.max(p, q, r));
  }
  return most;
}

/** The index of the position nearest to a place; -1: there is none. */
function nearestOf(positions: Float32Array, [x, y, z]: readonly [number, number, number]): number {
  let best = -1;
  let least = Infinity;
  for (let i = 0; i < positions.length; i += 3) {
    const distance = (positions[i]! - x) ** 2 + (positions[i + 1]! - y) ** 2 + (positions[i + 2]! - z) ** 2;
    if (distance >= least) continue;
    least = distance;
    best = i / 3;
  }
  return best;
}

const partOf = (geometry: BufferGeometry, vertex: number): number =>
  Math.round(geometry.getAttribute('_part').getX(vertex));

const cornerCount = ({ index, attributes }: BufferGeometry): number => {
  const count = index?.count ?? attributes['position']!.count;
  return count - (count % 3);
};

function tableOf(meshes: readonly Mesh[]): VertexTable {
  const count = meshes.reduce((sum, { geometry }) => sum + geometry.getAttribute('position').count, 0);
  const table = {
    positions: new Float32Array(count * 3),
    normals: new Float32Array(count * 3),
    numbers: new Int32Array(count),
    parts: new Int32Array(count).fill(-1),
    corners: new Uint32Array(meshes.reduce((sum, { geometry }) => sum + cornerCount(geometry), 0)),
  };
  let at = 0;
  let corners = 0;
  for (const { geometry, matrixWorld } of meshes) {
    const { index } = geometry;
    for (let i = 0; i < cornerCount(geometry); i += 1, corners += 1) table.corners[corners] = at + (index ? index.getX(i) : i);
    const position = geometry.getAttribute('position') as BufferAttribute;
    const normal = geometry.getAttribute('normal') as BufferAttribute;
    const hasParts = geometry.hasAttribute('_part');
    for (let v = 0; v < position.count; v += 1, at += 1) {
      corner.fromBufferAttribute(position, v).applyMatrix4(matrixWorld).toArray(table.positions, at * 3);
      corner.fromBufferAttribute(normal, v).toArray(table.normals, at * 3);
      table.numbers[at] = fileVertexOf(geometry, v);
      if (hasParts) table.parts[at] = partOf(geometry, v);
    }
  }
  return table;
}

/** The corners of the triangles of the parts that qualify. */
function cornersOf(geometry: BufferGeometry, qualifies: (part: number) => boolean): number[] {
  const { index } = geometry;
  const corners: number[] = [];
  if (!index || !geometry.hasAttribute('_part')) return corners;
  for (let i = 0; i + 2 < index.count; i += 3)
    if (qualifies(partOf(geometry, index.getX(i)))) corners.push(index.getX(i), index.getX(i + 1), index.getX(i + 2));
  return corners;
}

/** GLTFLoader converts the attribute name `_FILE_VERTEX` to lower case. */
function fileVertexOf(geometry: BufferGeometry, vertex: number): number {
  const numbers = geometry.getAttribute('_file_vertex');
  return numbers ? Math.round(numbers.getX(vertex)) : vertex;
}

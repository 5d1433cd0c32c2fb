import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Group,
  Material,
  MeshBasicMaterial,
  ShaderMaterial,
  Uint32BufferAttribute,
  Uint8BufferAttribute,
  Vector3,
} from 'three';
import { deformByCpu, deformByShader } from '@client/three/deform_material.ts';
import type { DeformPath, FaceView } from '@client/three/face_view.ts';
import { eyeOf } from '@protocol/weights_format.ts';
import { makeDiscs } from './markers.ts';

/** A feature point of the face: its vertex of the face's mesh, or null for a place without a vertex. */
export interface InfluencePoint {
  vertex: number | null;
  position: readonly [number, number, number];
}

/** How a feature point is drawn; null: not at all. sRGB, 0..255. */
export type Disc = { color: readonly [number, number, number]; size: number } | null;

/** `turn` of a vertex that turns fully with the head and does nothing else: see `faceRow` in deform_shader.ts. */
const turnsWithHead = (255 << 24) >>> 0;

/**
 * Paints the weights of feature points over a face, and the points as discs. The graphics card moves both with the face:
 * a displayed frame costs nothing here.
 */
export class InfluenceView {
  /** The triangles that are painted or opaque: a pointer sees through lashes and other transparent parts. */
  readonly indices: Uint32Array;
  /** What is drawn on the face besides. */
  readonly extras = new Group();
  private readonly surface: ShaderMaterial;
  private readonly materials: Material[];
  private readonly colours: Uint8BufferAttribute;
  private readonly discs = new BufferGeometry();
  private readonly discMaterials: Material[];
  private shown = false;

  /** `heat`: colours of weights from 0 to 1 at equal steps, sRGB, 0..255. */
  constructor(
    private readonly face: FaceView,
    private readonly points: readonly InfluencePoint[],
    heat: readonly (readonly [number, number, number])[],
  ) {
    const { mesh } = face;
    this.colours = new Uint8BufferAttribute(new Uint8Array(mesh.vertexCount * 4), 4, true);
    face.object.geometry.setAttribute('influence', this.colours);
    this.surface = surfaceMaterial(heat);
    const clear = new MeshBasicMaterial({ visible: false });
    const whole = { start: 0, count: mesh.indices.length, material: 0 };
    const groups = mesh.groups.length > 0 ? mesh.groups : [whole];
    const seen: number[] = [];
    this.materials = face.materials.slice();
    for (const { start, count, material } of groups) {
      const own = face.materials[material]!;
      if (own.transparent || own.alphaTest > 0) {
        this.materials[material] = clear;
        continue;
      }
      seen.push(start, count);
      if (!isEye(mesh.indices, mesh.rigid, start, count)) this.materials[material] = this.surface;
    }
    this.indices = joinRanges(mesh.indices, seen);

    this.makeDiscGeometry();
    const discs = makeDiscs(this.discs);
    this.discMaterials = discs.map(({ material }) => material);
    // The discs have rest positions of their own, which the shader moves on both paths.
    for (const { material } of discs) deformByShader(material, face.uniforms);
    this.extras.add(...discs);
    this.extras.visible = false;
    face.object.add(this.extras);
    this.usePath('gpu');
  }

  get on(): boolean {
    return this.shown;
  }

  set on(on: boolean) {
    this.shown = on;
    this.face.wear(on ? this.materials : null);
    this.extras.visible = on;
  }

  usePath(path: DeformPath): void {
    if (path === 'gpu') deformByShader(this.surface, this.face.uniforms);
    else deformByCpu(this.surface);
    this.surface.defines['FACE_ON_GPU'] = path === 'gpu' ? 1 : 0;
  }

  set wireframe(on: boolean) {
    this.surface.wireframe = on;
  }

  /** The four bytes of each vertex, to be written; then call `repaint`. */
  get paint(): Uint8Array {
    return this.colours.array as Uint8Array;
  }

  /** `heat`: the last of a vertex's bytes is a weight; otherwise it says whether the vertex is hatched. */
  repaint(heat: boolean): void {
    this.colours.needsUpdate = true;
    this.surface.uniforms['heat']!.value = heat ? 1 : 0;
  }

  /** Shows the feature points, in the order of the constructor's. */
  showDiscs(discs: readonly Disc[]): void {
    const color = this.discs.getAttribute('color') as BufferAttribute;
    const size = this.discs.getAttribute('size') as BufferAttribute;
    discs.forEach((disc, i) => {
      size.setX(i, disc?.size ?? 0);
      if (disc) mixed.setRGB(disc.color[0] / 255, disc.color[1] / 255, disc.color[2] / 255, 'srgb').toArray(color.array, i * 3);
    });
    color.needsUpdate = true;
    size.needsUpdate = true;
  }

  /** Where a point is on the moved face, whose vertices are `positions`; without a vertex, where it is at rest. */
  placeOf(point: number, positions: Float32Array, out: Vector3): Vector3 {
    const { vertex, position } = this.points[point]!;
    return vertex === null ? out.set(...position) : out.fromArray(positions, vertex * 3);
  }

  dispose(): void {
    this.on = false;
    this.extras.removeFromParent();
    this.discs.dispose();
    for (const material of [this.surface, ...this.discMaterials]) material.dispose();
  }

  private makeDiscGeometry(): void {
    const { face, points } = this;
    const count = points.length;
    const places = new Float32Array(count * 3);
    const normals = new Float32Array(count * 3);
    const rows = new Uint32Array(count * 2);
    const faceRows = face.object.geometry.getAttribute('faceRow').array as Uint32Array;
    points.forEach(({ vertex, position }, i) => {
      places.set(vertex === null ? position : face.mesh.positions.subarray(vertex * 3, vertex * 3 + 3), i * 3);
      normals.set(vertex === null ? [0, 0, 1] : face.mesh.normals.subarray(vertex * 3, vertex * 3 + 3), i * 3);
      rows.set(vertex === null ? [0, turnsWithHead] : faceRows.subarray(vertex * 2, vertex * 2 + 2), i * 2);
    });
    this.discs.dispose(); // the buffers of the attributes that are replaced
    this.discs.setAttribute('position', new BufferAttribute(places, 3));
    this.discs.setAttribute('normal', new BufferAttribute(normals, 3));
    this.discs.setAttribute('faceRow', new Uint32BufferAttribute(rows, 2));
    this.discs.setAttribute('color', new BufferAttribute(new Float32Array(count * 3), 3));
    this.discs.setAttribute('size', new BufferAttribute(new Float32Array(count), 1));
    this.discs.setAttribute('ring', new BufferAttribute(new Float32Array(count), 1));
  }
}

const mixed = new Color();

/** Whether all of these triangles turn with an eyeball: they keep their own look. */
function isEye(indices: Uint32Array, rigid: Uint8Array, start: number, count: number): boolean {
  for (let i = start; i < start + count; i += 1) if (eyeOf(rigid[indices[i]!]!) < 0) return false;
  return true;
}

/** `ranges`: start and count of each. */
function joinRanges(indices: Uint32Array, ranges: readonly number[]): Uint32Array {
  let length = 0;
  for (let i = 1; i < ranges.length; i += 2) length += ranges[i]!;
  const joined = new Uint32Array(length);
  let at = 0;
  for (let i = 0; i < ranges.length; i += 2) {
    joined.set(indices.subarray(ranges[i]!, ranges[i]! + ranges[i + 1]!), at);
    at += ranges[i + 1]!;
  }
  return joined;
}

/**
 * Colours as in the legend, darker only where the surface turns away: light and tone mapping would change them. The heat map
 * has lines at 25, 50 and 75 %.
 */
function surfaceMaterial(heat: readonly (readonly [number, number, number])[]): ShaderMaterial {
  return new ShaderMaterial({
    side: DoubleSide,
    uniforms: {
      heat: { value: 0 },
      ramp: { value: heat.map(([r, g, b]) => new Vector3(r / 255, g / 255, b / 255)) },
    },
    vertexShader: /* glsl */ `
      #include <common>
      attribute vec4 influence;
      varying vec4 painted;
      varying vec3 facing;
      void main() {
        #include <begin_vertex>
        #if FACE_ON_GPU == 1
          facing = normalMatrix * faceNormal;
        #else
          facing = normalMatrix * normal;
        #endif
        painted = influence;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(transformed, 1.0);
      }`,
    fragmentShader: /* glsl */ `
      uniform float heat;
      uniform vec3 ramp[${heat.length}];
      varying vec4 painted;
      varying vec3 facing;

      vec3 heatOf(float weight) {
        float at = clamp(weight, 0.0, 1.0) * ${(heat.length - 1).toFixed(1)};
        vec3 color = ramp[0];
        for (int i = 1; i < ${heat.length}; i += 1) color = mix(color, ramp[i], clamp(at - float(i - 1), 0.0, 1.0));
        return color;
      }

      void main() {
        vec3 color = painted.rgb;
        if (heat > 0.5) {
          float weight = painted.a;
          color = mix(color, heatOf(weight), smoothstep(0.004, 0.02, weight));
          float level = weight * 4.0;
          float apart = abs(fract(level + 0.5) - 0.5) / max(fwidth(level), 1e-5);
          float line = (1.0 - smoothstep(0.5, 1.3, apart)) * step(0.5, level) * step(level, 3.5);
          color = mix(color, weight > 0.6 ? vec3(0.0) : vec3(1.0), 0.45 * line);
        } else if (painted.a > 0.5) {
          float stripe = fract((gl_FragCoord.x + gl_FragCoord.y) / 12.0);
          color *= stripe < 0.4 ? 0.72 : 1.0;
        }
        float towards = abs(normalize(facing).z);
        gl_FragColor = vec4(color * (0.5 + 0.5 * sqrt(towards)), 1.0);
      }`,
  });
}

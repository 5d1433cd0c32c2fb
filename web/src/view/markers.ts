import { BufferAttribute, BufferGeometry, Color, Group, Points, ShaderMaterial, Vector3, type Camera, type WebGLRenderer } from 'three';

/** Marker styles of feature points and of the vertices of a finding. */
export type MarkerTone = 'error' | 'warning' | 'note' | 'placed' | 'proposed' | 'changed' | 'wrong' | 'selected';

export interface Marker {
  id: string;
  position: readonly [number, number, number];
  tone: MarkerTone;
}

const tones: Record<MarkerTone, { color: string; size: number; ring?: true }> = {
  error: { color: '#e5322d', size: 8 },
  warning: { color: '#f0a020', size: 8 },
  note: { color: '#2f7df6', size: 8 },
  placed: { color: '#2f7df6', size: 9 },
  proposed: { color: '#8b3fe0', size: 12, ring: true },
  changed: { color: '#f0a020', size: 10 },
  wrong: { color: '#e5322d', size: 12 },
  selected: { color: '#ff5a2c', size: 15 },
};

/**
 * Draws feature points as discs whose size on the screen is that of their tone, smaller while they crowd on a small face: opaque where visible,
 * faint where the head hides them (teeth, tongue, back of the head).
 */
export class Markers {
  readonly object = new Group();
  private readonly geometry = new BufferGeometry();
  private markers: Marker[] = [];

  constructor() {
    this.object.add(...makeDiscs(this.geometry));
  }

  get count(): number {
    return this.markers.length;
  }

  set(markers: Marker[]): void {
    this.markers = markers;
    const positions = new Float32Array(markers.length * 3);
    const colors = new Float32Array(markers.length * 3);
    const sizes = new Float32Array(markers.length);
    const rings = new Float32Array(markers.length);
    const color = new Color();
    markers.forEach((marker, i) => {
      positions.set(marker.position, i * 3);
      color.set(tones[marker.tone].color).toArray(colors, i * 3);
      sizes[i] = tones[marker.tone].size;
      rings[i] = tones[marker.tone].ring ? 1 : 0;
    });
    this.geometry.dispose(); // the buffers of the attributes that are replaced
    this.geometry.setAttribute('position', new BufferAttribute(positions, 3));
    this.geometry.setAttribute('color', new BufferAttribute(colors, 3));
    this.geometry.setAttribute('size', new BufferAttribute(sizes, 1));
    this.geometry.setAttribute('ring', new BufferAttribute(rings, 1));
    this.geometry.computeBoundingSphere();
  }

  of(id: string): Marker | null {
    return this.markers.find((marker) => marker.id === id) ?? null;
  }

  /** Moves one marker, until `set` is called again. */
  moveTo(id: string, position: readonly [number, number, number]): void {
    const at = this.markers.findIndex((marker) => marker.id === id);
    const marker = this.markers[at];
    if (!marker) return;
    marker.position = position;
    const positions = this.geometry.getAttribute('position') as BufferAttribute;
    positions.setXYZ(at, ...position);
    positions.needsUpdate = true;
  }

  /** The marker nearest to a place on the canvas, within `reach` pixels; else null. */
  at(x: number, y: number, camera: Camera, width: number, height: number, reach: number): Marker | null {
    let best: Marker | null = null;
    let bestDistance = reach;
    for (const marker of this.markers) {
      const place = this.project(marker.position, camera, width, height);
      const distance = Math.hypot(place.x - x, place.y - y);
      if (distance < bestDistance) {
        best = marker;
        bestDistance = distance;
      }
    }
    return best;
  }

  project(
    position: readonly [number, number, number],
    camera: Camera,
    width: number,
    height: number,
  ): { x: number; y: number } {
    projected.set(...position).project(camera);
    return { x: ((projected.x + 1) / 2) * width, y: ((1 - projected.y) / 2) * height };
  }
}

const projected = new Vector3();

/** Fewer discs than these hide no face. */
const leastCrowd = 20;
/** Discs shrink to this share at most, where they are so many to so small a width that each has less room than `room`, CSS pixels. */
const [smallest, room] = [0.6, 36];

/** The share of their size that discs are drawn at: `count` of them over `width` CSS pixels. */
export function discShare(count: number, width: number): number {
  return count < leastCrowd ? 1 : Math.min(1, Math.max(smallest, width / Math.sqrt(count) / room));
}

/** How wide a geometry is on the screen, CSS pixels. */
function widthOf(points: Points<BufferGeometry>, renderer: WebGLRenderer, camera: Camera): number {
  const sphere = points.geometry.boundingSphere;
  if (!sphere) return Infinity;
  const depth = -projected.copy(sphere.center).applyMatrix4(points.modelViewMatrix).z;
  const tangent = 1 / camera.projectionMatrix.elements[5]!;
  return depth > 0 ? (sphere.radius * renderer.domElement.clientHeight) / (depth * tangent) : Infinity;
}

/**
 * Draws the points of a geometry (attributes `position`, `color`, `size`: CSS pixels, `ring`: 0 or 1) as discs: opaque where
 * visible, faint where something hides them.
 */
export function makeDiscs(geometry: BufferGeometry): Points<BufferGeometry, ShaderMaterial>[] {
  return [discMaterial(0.22, false), discMaterial(1, true)].map((material, order) => {
    const points = new Points(geometry, material);
    points.frustumCulled = false;
    points.onBeforeRender = (renderer, _, camera) => {
      const share = discShare(geometry.getAttribute('position').count, widthOf(points, renderer, camera));
      material.uniforms['ratio']!.value = renderer.getPixelRatio() * share;
    };
    points.renderOrder = 10 + order;
    return points;
  });
}

function discMaterial(opacity: number, depthTest: boolean): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { ratio: { value: 1 }, opacity: { value: opacity } },
    vertexShader: /* glsl */ `
      #include <common>
      attribute vec3 color;
      attribute float size;
      attribute float ring;
      uniform float ratio;
      varying vec3 tint;
      varying float rim;
      varying float open;
      void main() {
        tint = color;
        open = ring;
        #include <begin_vertex>
        gl_Position = projectionMatrix * modelViewMatrix * vec4(transformed, 1.0);
        // A small depth offset towards the camera, so that the skin at the point does not hide the marker.
        gl_Position.z -= 0.0025 * gl_Position.w;
        gl_PointSize = size * ratio;
        rim = 1.6 / size;
      }`,
    fragmentShader: /* glsl */ `
      uniform float opacity;
      varying vec3 tint;
      varying float rim;
      varying float open;
      void main() {
        float r = length(gl_PointCoord - 0.5);
        float edge = fwidth(r);
        float inside = 1.0 - smoothstep(0.5 - edge, 0.5, r);
        float core = 1.0 - smoothstep(0.5 - rim - edge, 0.5 - rim, r);
        // Proposed points have a pale centre, so that they differ by shape and not by colour alone.
        float middle = 1.0 - smoothstep(0.13, 0.13 + edge, r);
        core *= 1.0 - open * middle;
        if (inside * opacity < 0.01) discard;
        gl_FragColor = vec4(mix(vec3(1.0), tint, core), inside * opacity);
        #include <colorspace_fragment>
      }`,
    transparent: true,
    depthWrite: false,
    depthTest,
  });
}

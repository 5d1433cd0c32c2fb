import {
  BufferAttribute,
  Group,
  Mesh,
  Raycaster,
  Vector2,
  Vector3,
  type BufferGeometry,
  type Camera,
  type Material,
  type Object3D,
} from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { defaultMaterial, studioMaterial } from './materials.ts';

/** A place on the mesh: the file's own number of the vertex nearest to where the pointer hit. */
export interface Pick {
  fileVertex: number;
  position: [number, number, number];
}

/** The model as it was imported: still, with its materials, and every vertex knows its number in the file. */
export class PreviewView {
  readonly object = new Group();
  private readonly meshes: Mesh[] = [];
  private readonly raycaster = new Raycaster();
  private readonly pointer = new Vector2();
  private positionOfFileVertex: Map<number, Vector3> | null = null;

  private constructor(
    scene: Object3D,
    /** By the number of the material in the file. */
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
    for (const mesh of this.meshes)
      if ('wireframe' in (mesh.material as object)) (mesh.material as unknown as { wireframe: boolean }).wireframe = on;
  }

  /** `x`, `y` in -1..1 from the lower left. */
  pick(x: number, y: number, camera: Camera): Pick | null {
    this.raycaster.setFromCamera(this.pointer.set(x, y), camera);
    const hit = this.raycaster.intersectObjects(this.meshes, false)[0];
    if (!hit?.face) return null;
    const mesh = hit.object as Mesh;
    const position = mesh.geometry.getAttribute('position') as BufferAttribute;
    let best = -1;
    let bestDistance = Infinity;
    for (const vertex of [hit.face.a, hit.face.b, hit.face.c]) {
      const distance = corner
        .fromBufferAttribute(position, vertex)
        .applyMatrix4(mesh.matrixWorld)
        .distanceTo(hit.point);
      if (distance < bestDistance) {
        bestDistance = distance;
        best = vertex;
      }
    }
    corner.fromBufferAttribute(position, best).applyMatrix4(mesh.matrixWorld);
    return { fileVertex: fileVertexOf(mesh.geometry, best), position: [corner.x, corner.y, corner.z] };
  }

  /** Where a vertex of the file lies, or null if no triangle uses it. */
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
  }
}

const corner = new Vector3();

/** GLTFLoader lowers the case of `_FILE_VERTEX`. */
function fileVertexOf(geometry: BufferGeometry, vertex: number): number {
  const numbers = geometry.getAttribute('_file_vertex');
  return numbers ? Math.round(numbers.getX(vertex)) : vertex;
}

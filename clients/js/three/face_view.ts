import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DynamicDrawUsage,
  Mesh,
  MeshDepthMaterial,
  RGBADepthPacking,
  SRGBColorSpace,
  Uint32BufferAttribute,
  type Material,
} from 'three';
import { deformNormals } from '../gpu/deform_reference.ts';
import { rowNumbers } from '../gpu/deform_shader.ts';
import type { DrawableMesh } from '../gpu/drawable_mesh.ts';
import { makeTangentTable, type TangentTable } from '../gpu/tangent_table.ts';
import type { Pose } from '../kernel.ts';
import { deformByCpu, deformByShader, makeDeformUniforms, setPose, type DeformUniforms } from './deform_material.ts';
import { makeSolidPart } from './solid_part.ts';

/** three.js takes the colours of vertices as linear light. */
function linearColors(srgb: Uint8Array): Float32Array {
  const grey = new Color();
  const light = Float32Array.from({ length: 256 }, (_, i) => grey.setRGB(i / 255, 0, 0, SRGBColorSpace).r);
  return Float32Array.from(srgb, (value) => light[value]!);
}

export type DeformPath = 'gpu' | 'wasm';

/** An animated face, deformed by the shader (default) or by the WASM kernel. Both paths draw the same picture. */
export class FaceView {
  readonly object: Mesh;
  readonly uniforms: DeformUniforms;
  private readonly table: TangentTable;
  private readonly depthMaterial = new MeshDepthMaterial({ depthPacking: RGBADepthPacking });
  private readonly solid: Mesh | null;

  constructor(
    readonly mesh: DrawableMesh,
    readonly materials: Material[],
  ) {
    this.table = makeTangentTable(mesh);
    this.uniforms = makeDeformUniforms(this.table);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(mesh.positions.slice(), 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute('normal', new BufferAttribute(mesh.normals.slice(), 3).setUsage(DynamicDrawUsage));
    if (mesh.uvs) geometry.setAttribute('uv', new BufferAttribute(mesh.uvs, 2));
    if (mesh.colors) geometry.setAttribute('color', new BufferAttribute(linearColors(mesh.colors), 3));
    geometry.setAttribute('faceRow', new Uint32BufferAttribute(rowNumbers(mesh, this.table), 2));
    geometry.setIndex(new BufferAttribute(mesh.indices, 1));
    for (const group of mesh.groups) geometry.addGroup(group.start, group.count, group.material);
    geometry.computeBoundingSphere();
    this.object = new Mesh(geometry, materials);
    // The deformed head leaves the bounding box of the rest pose, so frustum culling would be wrong.
    this.object.frustumCulled = false;
    this.object.castShadow = true;
    this.object.receiveShadow = true;
    this.object.customDepthMaterial = this.depthMaterial;
    this.solid = makeSolidPart(this.object);
    if (this.solid) {
      this.solid.frustumCulled = false;
      this.solid.receiveShadow = true;
      this.object.add(this.solid);
    }
    this.usePath('gpu');
  }

  usePath(path: DeformPath): void {
    for (const material of [...this.materials, ...this.solidMaterials, this.depthMaterial]) {
      if (path === 'gpu') deformByShader(material, this.uniforms);
      else deformByCpu(material);
    }
    if (path === 'gpu') this.write(this.mesh.positions, this.mesh.normals);
  }

  /** GPU path: sets the pose of the shader. Allocates nothing, as it runs once per displayed frame. */
  setPose(pose: Pose): void {
    setPose(this.uniforms, pose);
  }

  /** WASM path: sets the vertices that the kernel computed for this pose. */
  setVertices(positions: Float32Array, pose: Pose): void {
    const normal = this.object.geometry.getAttribute('normal') as BufferAttribute;
    this.writePositions(positions);
    deformNormals(this.mesh, this.table, pose, normal.array as Float32Array);
    normal.needsUpdate = true;
  }

  set wireframe(on: boolean) {
    for (const material of [...this.materials, ...this.solidMaterials])
      if ('wireframe' in material) material.wireframe = on;
  }

  /** Draws the face with other materials, one for each of its own; null: with its own again. */
  wear(materials: Material[] | null): void {
    this.object.material = materials ?? this.materials;
    if (this.solid) this.solid.visible = materials === null;
  }

  dispose(): void {
    this.object.geometry.dispose();
    for (const material of this.solidMaterials) material.dispose();
    this.uniforms.faceEntries.value.dispose();
    this.depthMaterial.dispose();
    this.object.removeFromParent();
  }

  private get solidMaterials(): Material[] {
    return this.solid ? [this.solid.material].flat() : [];
  }

  private write(positions: Float32Array, normals: Float32Array): void {
    this.writePositions(positions);
    const normal = this.object.geometry.getAttribute('normal') as BufferAttribute;
    (normal.array as Float32Array).set(normals);
    normal.needsUpdate = true;
  }

  private writePositions(positions: Float32Array): void {
    const position = this.object.geometry.getAttribute('position') as BufferAttribute;
    (position.array as Float32Array).set(positions);
    position.needsUpdate = true;
  }
}

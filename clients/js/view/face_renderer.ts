import type { RigMaterial } from '../../../protocol/ts/rig_document.ts';
import type { DrawableMesh } from '../gpu/drawable_mesh.ts';
import { entryTexels, rowNumbers, tableWidth } from '../gpu/deform_shader.ts';
import {
  bareSkinColor,
  isSkinLike,
  leastOpacity,
  mostMetalness,
  skinLook,
  skinRoughness,
  solidOpacity,
  studioLight,
  whiteLevel,
} from '../gpu/studio_look.ts';
import { makeTangentTable, type TangentTable } from '../gpu/tangent_table.ts';
import { ballPlaces, lidFields, type Pose } from '../kernel.ts';
import { sunMatrix, unit, type OrbitCamera, type Vec3 } from './camera.ts';
import type { Environment } from './environment.ts';
import { linear, scaled } from './gl.ts';
import { graphicsFor, type Graphics, type GraphicsUser } from './graphics.ts';

/** Opaque materials, then what is solid of the transparent ones, then those as a whole. */
const passes = ['opaque', 'solid', 'blended'] as const;
type Pass = (typeof passes)[number];

/** What a device can do at once. */
export interface RenderQuality {
  antialias: boolean;
  shadows: boolean;
  richSkin: boolean;
  /** Edge length of the surroundings' cube map, pixels; a power of two of at least 32. */
  roomSize: number;
  maxPixelRatio: number;
}

/** The images of one material, as far as they have arrived. */
interface Images {
  base: WebGLTexture | null;
  normal: WebGLTexture | null;
  /** 0: the plain colour, 1: the image */
  share: number;
}

type Values = Float32Array | Uint32Array | Uint8Array;

interface Loaded {
  mesh: DrawableMesh;
  table: TangentTable;
  materials: readonly RigMaterial[];
  bitmaps: (readonly [ImageBitmap | null, ImageBitmap | null])[];
}

/** Of meshes that several faces of the page have. */
const tables = new WeakMap<DrawableMesh, TangentTable>();
/** Seconds in which the colours of an image replace the plain colour. */
const fadeTime = 0.35;

/**
 * Draws one face with WebGL 2 and nothing else: deformation on the GPU, the studio's light and skin, one shadow. After a
 * lost graphics context everything is made again.
 */
export class FaceRenderer implements GraphicsUser {
  /** Called when the picture must be drawn again for another reason than the pose, and when `isLost` changes. */
  onChange: () => void = () => undefined;
  /** Shows the picture. Another one replaces it when its context does not come back. */
  private canvas = document.createElement('canvas');
  private graphics: Graphics;
  private loaded: Loaded | null = null;
  private images: Images[] = [];
  private vertices: WebGLVertexArrayObject | null = null;
  private buffers: WebGLBuffer[] = [];
  private entries: WebGLTexture | null = null;
  private readonly lids = new Float32Array(2 * ballPlaces);
  private fading = false;
  private isAway = false;

  /** The canvas becomes a child of `host`. Throws when the browser gives no WebGL 2. */
  constructor(
    host: HTMLElement,
    private quality: RenderQuality,
    private readonly fades: boolean,
  ) {
    this.graphics = graphicsFor(this.canvas, quality.antialias);
    this.graphics.add(this);
    if (!this.isLost) this.graphics.environment(quality.roomSize); // before the face is there: it takes a while
    host.append(this.canvas);
  }

  private get gl(): WebGL2RenderingContext {
    return this.graphics.gl;
  }

  /** Whether nothing can be drawn at present. */
  get isLost(): boolean {
    return this.graphics.isLost;
  }

  lost(): void {
    this.onChange();
  }

  restored(): void {
    this.vertices = this.entries = null;
    this.buffers = [];
    this.images = [];
    this.upload();
  }

  moved(next: Graphics): void {
    this.graphics.remove(this);
    this.graphics = next;
    next.add(this);
    const { width, height } = this.canvas;
    const canvas = document.createElement('canvas');
    this.canvas.replaceWith(canvas);
    this.canvas = canvas;
    this.resize(width, height);
    this.restored();
  }

  /** While it is away the face keeps nothing in the context. */
  setAway(isAway: boolean): void {
    if (isAway === this.isAway) return;
    this.isAway = isAway;
    if (isAway) this.releaseFace();
    else this.upload();
  }

  /** Pixels. */
  resize(width: number, height: number): void {
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    this.onChange();
  }

  /** Turns shadow and rich skin off on a slow device; smoothed edges belong to the context and stay. */
  setQuality(quality: RenderQuality): void {
    this.quality = quality;
    this.onChange();
  }

  /** Replaces the face. Images of materials with the same content stay with the caller: give them again. */
  setFace(mesh: DrawableMesh, materials: readonly RigMaterial[]): void {
    this.releaseFace();
    let table = tables.get(mesh);
    if (!table) tables.set(mesh, (table = makeTangentTable(mesh)));
    this.loaded = { mesh, table, materials, bitmaps: materials.map(() => [null, null] as const) };
    this.upload();
  }

  /** Brings the face and its images into the context, which has nothing of it, unless it is lost or not needed. */
  private upload(): void {
    if (!this.loaded || this.isLost || this.isAway) return;
    const { gl } = this;
    const { mesh, table, materials, bitmaps } = this.loaded;
    this.entries = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.entries);
    const texels = entryTexels(table);
    const rows = texels.length / 4 / tableWidth;
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, tableWidth, rows, 0, gl.RGBA, gl.FLOAT, texels);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);

    this.vertices = gl.createVertexArray();
    gl.bindVertexArray(this.vertices);
    const rowsOfVertices = rowNumbers(mesh, table);
    for (const { program } of [this.graphics.program, this.graphics.shadowProgram]) {
      this.attribute(program, 'position', mesh.positions, 3);
      this.attribute(program, 'normal', mesh.normals, 3);
      if (mesh.uvs) this.attribute(program, 'uv', mesh.uvs, 2);
      if (mesh.colors) this.attribute(program, 'srgb', mesh.colors, 3);
      this.attribute(program, 'faceRow', rowsOfVertices, 2);
    }
    // A mesh without colours is white. The value belongs to the context, not to the vertex array.
    gl.vertexAttrib3f(gl.getAttribLocation(this.graphics.program.program, 'srgb'), 1, 1, 1);
    this.fill(gl.ELEMENT_ARRAY_BUFFER, mesh.indices);
    gl.bindVertexArray(null);
    this.images = materials.map(() => ({ base: null, normal: null, share: 1 }));
    bitmaps.forEach((_, i) => this.uploadImages(i));
    this.onChange();
  }

  private attribute(program: WebGLProgram, name: string, values: Values, size: number): void {
    const { gl } = this;
    const at = gl.getAttribLocation(program, name);
    if (at < 0) return;
    this.fill(gl.ARRAY_BUFFER, values);
    gl.enableVertexAttribArray(at);
    if (values instanceof Uint32Array) gl.vertexAttribIPointer(at, size, gl.UNSIGNED_INT, 0, 0);
    else if (values instanceof Uint8Array) gl.vertexAttribPointer(at, size, gl.UNSIGNED_BYTE, true, 0, 0);
    else gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, 0);
  }

  private fill(target: number, values: Values): void {
    const buffer = this.gl.createBuffer();
    this.gl.bindBuffer(target, buffer);
    this.gl.bufferData(target, values, this.gl.STATIC_DRAW);
    this.buffers.push(buffer);
  }

  /** Sets the images of a material when they have arrived; null: it has none. */
  setImages(material: number, base: ImageBitmap | null, normal: ImageBitmap | null): void {
    if (!this.loaded) return;
    this.loaded.bitmaps[material] = [base, normal];
    this.uploadImages(material);
    const images = this.images[material];
    if (!images) return;
    images.share = this.fades ? 0 : 1;
    this.fading = this.fades;
    this.onChange();
  }

  private uploadImages(material: number): void {
    const images = this.images[material];
    const [base, normal] = this.loaded!.bitmaps[material]!;
    if (!images) return;
    const { graphics, gl } = this;
    const before = [images.base, images.normal];
    images.base = base && graphics.texture(base, gl.SRGB8_ALPHA8);
    images.normal = normal && graphics.texture(normal, gl.RGBA8);
    for (const texture of before) graphics.dropTexture(texture);
  }

  /** Whether the next picture differs even if the pose does not. */
  get isFading(): boolean {
    return this.fading;
  }

  /** Draws a pose. The canvas must have its size in pixels. `deltaSeconds`: since the last picture, for the fading. */
  draw(pose: Pose, camera: OrbitCamera, deltaSeconds: number): void {
    const { gl, loaded, vertices, graphics } = this;
    if (!loaded || !vertices || this.isLost) return;
    this.fading = false;
    for (const images of this.images) {
      if (images.base && images.share < 1) images.share = Math.min(1, images.share + deltaSeconds / fadeTime);
      if (images.base && images.share < 1) this.fading = true;
    }
    const { width, height } = this.canvas;
    camera.update(width / height);
    const { centre, half } = camera.subject;
    const radius = Math.max(half[0], half[1], half[2] * 0.8);
    const at = (place: readonly number[]): Vec3 => centre.map((c, i) => c + radius * place[i]!) as Vec3;
    const { shadow, key } = studioLight;
    const sun = at(key.place);
    const sunCamera = sunMatrix(sun, centre, radius * shadow.reach, radius * shadow.near, radius * shadow.far);

    const light = graphics.environment(this.quality.roomSize);
    graphics.begin(this.canvas);
    gl.bindVertexArray(vertices);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.entries);
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
    if (this.quality.shadows) this.drawShadow(pose, loaded.mesh, sunCamera);

    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const { program, at: uniform } = graphics.program;
    gl.useProgram(program);
    this.setPose(uniform, pose);
    this.setLight(uniform, camera, light, sunCamera, radius, at);
    for (const pass of passes) {
      if (pass === 'blended') {
        gl.depthMask(false);
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      }
      for (const { start, count, material } of loaded.mesh.groups) {
        const facts = loaded.materials[material];
        if (!facts || (facts.alpha_mode === 'blend') !== (pass !== 'opaque')) continue;
        if (pass === 'solid' && !this.images[material]!.base) continue;
        this.setMaterial(uniform, facts, this.images[material]!, pass);
        gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, start * 4);
      }
    }
    gl.depthMask(true);
    gl.bindVertexArray(null);
    graphics.end(this.canvas);
  }

  private drawShadow(pose: Pose, mesh: DrawableMesh, sunCamera: Float32Array): void {
    const { gl } = this;
    const { size } = studioLight.shadow;
    const { target } = this.graphics.shadowMap(size);
    // The map must not be bound for reading while it is drawn.
    gl.activeTexture(gl.TEXTURE5);
    gl.bindTexture(gl.TEXTURE_2D, null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.viewport(0, 0, size, size);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    const { program, at } = this.graphics.shadowProgram;
    gl.useProgram(program);
    this.setPose(at, pose);
    gl.uniformMatrix4fv(at['camera'] ?? null, false, sunCamera);
    for (const { start, count, material } of mesh.groups) {
      if (this.loaded!.materials[material]?.alpha_mode === 'blend') continue;
      gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, start * 4);
    }
  }

  private setLight(
    uniform: Record<string, WebGLUniformLocation>,
    camera: OrbitCamera,
    { radiance, irradiance }: Environment,
    sunCamera: Float32Array,
    radius: number,
    at: (place: readonly number[]) => Vec3,
  ): void {
    const { gl, quality } = this;
    const { hemisphere, key, rim, shadow, environment } = studioLight;
    const { centre } = camera.subject;
    const towards = (place: readonly number[]): Vec3 => unit(at(place).map((x, i) => x - centre[i]!) as Vec3);
    const set = (name: string): WebGLUniformLocation | null => uniform[name] ?? null;
    gl.uniformMatrix4fv(set('camera'), false, camera.matrix);
    gl.uniformMatrix4fv(set('shadowCamera'), false, sunCamera);
    gl.uniform1f(set('shadowOffset'), shadow.normalBias * radius);
    gl.uniform3fv(set('eye'), camera.eye);
    gl.uniform3fv(set('skyColor'), scaled(linear(hemisphere.sky), hemisphere.intensity));
    gl.uniform3fv(set('groundColor'), scaled(linear(hemisphere.ground), hemisphere.intensity));
    gl.uniform3fv(set('keyDirection'), towards(key.place));
    gl.uniform3fv(set('keyColor'), scaled(linear(key.color), key.intensity));
    gl.uniform3fv(set('rimDirection'), towards(rim.place));
    gl.uniform3fv(set('rimColor'), scaled(linear(rim.color), rim.intensity));
    gl.uniform1f(set('environmentShare'), environment);
    gl.uniform1i(set('hasShadow'), quality.shadows ? 1 : 0);
    gl.uniform1f(set('shadowShare'), shadow.intensity);
    gl.uniform1f(set('shadowBias'), shadow.bias);
    gl.uniform1f(set('shadowSoftness'), shadow.softness / shadow.size);
    gl.uniform3fv(set('sheenColor'), scaled(linear(skinLook.sheenColor), skinLook.sheen));
    const units = ['faceEntries', 'baseMap', 'normalMap', 'radiance', 'irradiance', 'shadowMap'];
    units.forEach((name, i) => gl.uniform1i(set(name), i));
    const { map } = this.graphics.shadowMap(quality.shadows ? shadow.size : 1);
    gl.activeTexture(gl.TEXTURE3);
    gl.bindTexture(gl.TEXTURE_CUBE_MAP, radiance);
    gl.activeTexture(gl.TEXTURE4);
    gl.bindTexture(gl.TEXTURE_CUBE_MAP, irradiance);
    gl.activeTexture(gl.TEXTURE5);
    gl.bindTexture(gl.TEXTURE_2D, map);
  }

  private setMaterial(uniform: Record<string, WebGLUniformLocation>, facts: RigMaterial, images: Images, pass: Pass): void {
    const { gl } = this;
    const set = (name: string): WebGLUniformLocation | null => uniform[name] ?? null;
    const blended = facts.alpha_mode === 'blend';
    const isSkin = this.quality.richSkin && isSkinLike(facts.name, facts.roughness, blended);
    const hasImage = facts.base_color_image !== null;
    const [r, g, b, a] = facts.base_color;
    // Until its image is there, and without one, a plain white material of skin has a skin's colour, unless its vertices
    // have theirs.
    const bare = !this.loaded!.mesh.colors && Math.min(r, g, b) > whiteLevel && (!hasImage || isSkinLike(facts.name, facts.roughness, blended));
    gl.uniform4f(set('baseColor'), r, g, b, a);
    gl.uniform4fv(set('plainColor'), bare ? [...linear(bareSkinColor), a] : hasImage && blended ? [r, g, b, 0] : [r, g, b, a]);
    gl.uniform1f(set('mapShare'), images.base ? images.share : 0);
    const cutoff = facts.alpha_mode === 'mask' ? facts.alpha_cutoff : 0;
    gl.uniform1f(set('alphaTest'), { opaque: cutoff, solid: solidOpacity, blended: leastOpacity }[pass]);
    gl.uniform1i(set('isOpaque'), pass === 'blended' ? 0 : 1);
    gl.uniform1f(set('roughness'), isSkin ? skinRoughness(facts.roughness) : facts.roughness);
    gl.uniform1f(set('metalness'), isSkin ? 0 : Math.min(facts.metallic, mostMetalness));
    gl.uniform1i(set('isSkin'), isSkin ? 1 : 0);
    gl.uniform1i(set('hasNormalMap'), images.normal ? 1 : 0);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, images.base ?? this.graphics.white);
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D, images.normal ?? this.graphics.white);
  }

  private setPose(uniform: Record<string, WebGLUniformLocation>, pose: Pose): void {
    const { gl, lids } = this;
    const set = (name: string): WebGLUniformLocation | null => uniform[name] ?? null;
    gl.uniform1i(set('faceEntries'), 0);
    gl.uniform3fv(set('facePoints'), pose.featurePoints);
    gl.uniform4fv(set('faceEyeRotation'), pose.eyeRotations);
    gl.uniform3fv(set('faceEyePivot'), pose.eyePivots);
    gl.uniform3fv(set('faceEyeTranslation'), pose.eyeTranslations);
    gl.uniform4fv(set('faceHeadRotation'), pose.headRotation);
    gl.uniform3fv(set('faceHeadPivot'), pose.headPivot);
    gl.uniform1fv(set('facePupilGrowth'), pose.pupilGrowth);
    gl.uniform1f(set('faceTongueRoll'), pose.tongueRoll[0]!);
    gl.uniform3fv(set('faceTongueOrigin'), pose.tongue, 0, 3);
    gl.uniform3fv(set('faceTongueLeft'), pose.tongue, 3, 3);
    gl.uniform3fv(set('faceTongueUp'), pose.tongue, 6, 3);
    gl.uniform1f(set('faceTongueHalfWidth'), pose.tongue[9]!);
    gl.uniform1fv(set('faceLidClosure'), pose.lidClosures);
    const { irises, lids: given } = pose;
    const two = (a: number, b: number, source: Float32Array): number[] => [...source.subarray(a, a + 3), ...source.subarray(b, b + 3)];
    gl.uniform3fv(set('faceIrisAxis'), two(0, 6, irises));
    gl.uniform3fv(set('faceIrisShape'), two(3, 9, irises));
    gl.uniform3fv(set('faceLidGaze'), two(lidFields.gaze, lidFields.count + lidFields.gaze, given));
    const ofBoth = (field: number): number[] => [given[field]!, given[lidFields.count + field]!];
    gl.uniform1fv(set('faceLidOpening'), ofBoth(lidFields.opening));
    gl.uniform1fv(set('faceLidLift'), ofBoth(lidFields.lift));
    for (let side = 0; side < 2; side += 1) {
      const from = side * lidFields.count + lidFields.ball;
      lids.set(given.subarray(from, from + ballPlaces), side * ballPlaces);
    }
    gl.uniform1fv(set('faceLidBall'), lids);
  }

  private releaseFace(): void {
    const { gl } = this;
    for (const buffer of this.buffers) gl.deleteBuffer(buffer);
    for (const { base, normal } of this.images) for (const texture of [base, normal]) this.graphics.dropTexture(texture);
    gl.deleteVertexArray(this.vertices);
    gl.deleteTexture(this.entries);
    this.buffers = [];
    this.images = [];
    this.vertices = this.entries = null;
  }

  dispose(): void {
    this.releaseFace();
    this.loaded = null;
    this.graphics.remove(this);
  }
}

import type { RigMaterial } from '../../../protocol/ts/rig_document.ts';
import type { DrawableMesh } from '../gpu/drawable_mesh.ts';
import { entryTexels, rowNumbers, tableWidth } from '../gpu/deform_shader.ts';
import { bareSkinColor, isSkinLike, mostMetalness, skinLook, skinRoughness, studioLight, whiteLevel } from '../gpu/studio_look.ts';
import { makeTangentTable } from '../gpu/tangent_table.ts';
import { ballPlaces, lidFields, type Pose } from '../kernel.ts';
import { sunMatrix, unit, type OrbitCamera, type Vec3 } from './camera.ts';
import { makeEnvironment, type Environment } from './environment.ts';
import { alphaTestOfBlend, faceFragment, faceVertex, shadowFragment, shadowVertex } from './face_shader.ts';
import { linear, makeProgram, scaled, uniformsOf } from './gl.ts';

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

interface Loaded {
  mesh: DrawableMesh;
  materials: readonly RigMaterial[];
  bitmaps: (readonly [ImageBitmap | null, ImageBitmap | null])[];
}

type Program = { program: WebGLProgram; at: Record<string, WebGLUniformLocation> };

/** Seconds in which the colours of an image replace the plain colour. */
const fadeTime = 0.35;

/**
 * Draws one face with WebGL 2 and nothing else: deformation on the GPU, the studio's light and skin, one shadow. After a
 * lost graphics context everything is made again.
 */
export class FaceRenderer {
  /** Called when the picture must be drawn again for another reason than the pose. */
  onChange: () => void = () => undefined;

  private readonly gl: WebGL2RenderingContext;
  private environment!: Environment;
  private program!: Program;
  private shadowProgram!: Program;
  private shadow: { target: WebGLFramebuffer; map: WebGLTexture; size: number } | null = null;
  private white!: WebGLTexture;
  private loaded: Loaded | null = null;
  private images: Images[] = [];
  private vertices: WebGLVertexArrayObject | null = null;
  private buffers: WebGLBuffer[] = [];
  private entries: WebGLTexture | null = null;
  private readonly lids = new Float32Array(2 * ballPlaces);
  private fading = false;

  /** Throws when the browser gives no WebGL 2. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    private quality: RenderQuality,
    private readonly fades: boolean,
  ) {
    const gl = canvas.getContext('webgl2', {
      alpha: true,
      antialias: quality.antialias,
      premultipliedAlpha: true,
      powerPreference: 'high-performance',
    });
    if (!gl) throw new Error('WebGL 2 is not available');
    this.gl = gl;
    canvas.addEventListener('webglcontextlost', this.onLost);
    canvas.addEventListener('webglcontextrestored', this.onRestored);
    this.start();
  }

  private readonly onLost = (event: Event): void => event.preventDefault(); // lets the browser give it back
  private readonly onRestored = (): void => {
    this.start();
    const { loaded } = this;
    if (loaded) {
      this.setFace(loaded.mesh, loaded.materials);
      loaded.bitmaps.forEach(([base, normal], i) => this.setImages(i, base, normal));
    }
    this.onChange();
  };

  /** Turns shadow and rich skin off on a slow device; smoothed edges belong to the context and stay. */
  setQuality(quality: RenderQuality): void {
    this.quality = quality;
    this.onChange();
  }

  private start(): void {
    const { gl } = this;
    this.shadow = null;
    this.vertices = this.entries = null;
    this.buffers = [];
    this.images = [];
    this.program = this.make(faceVertex, faceFragment);
    this.shadowProgram = this.make(shadowVertex, shadowFragment);
    this.environment = makeEnvironment(gl, this.quality.roomSize);
    this.white = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.white);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4).fill(255));
  }

  private make(vertex: string, fragment: string): Program {
    const program = makeProgram(this.gl, vertex, fragment);
    return { program, at: uniformsOf(this.gl, program) };
  }

  /** Replaces the face. Images of materials with the same content stay with the caller: give them again. */
  setFace(mesh: DrawableMesh, materials: readonly RigMaterial[]): void {
    const { gl } = this;
    this.releaseFace();
    const table = makeTangentTable(mesh);
    this.loaded = { mesh, materials, bitmaps: materials.map(() => [null, null] as const) };
    this.images = materials.map(() => ({ base: null, normal: null, share: 0 }));

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
    for (const { program } of [this.program, this.shadowProgram]) {
      this.attribute(program, 'position', mesh.positions, 3);
      this.attribute(program, 'normal', mesh.normals, 3);
      if (mesh.uvs) this.attribute(program, 'uv', mesh.uvs, 2);
      this.attribute(program, 'faceRow', rowsOfVertices, 2);
    }
    this.upload(gl.ELEMENT_ARRAY_BUFFER, mesh.indices);
    gl.bindVertexArray(null);
  }

  private attribute(program: WebGLProgram, name: string, values: Float32Array | Uint32Array, size: number): void {
    const { gl } = this;
    const at = gl.getAttribLocation(program, name);
    if (at < 0) return;
    this.upload(gl.ARRAY_BUFFER, values);
    gl.enableVertexAttribArray(at);
    if (values instanceof Uint32Array) gl.vertexAttribIPointer(at, size, gl.UNSIGNED_INT, 0, 0);
    else gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, 0);
  }

  private upload(target: number, values: Float32Array | Uint32Array): void {
    const buffer = this.gl.createBuffer();
    this.gl.bindBuffer(target, buffer);
    this.gl.bufferData(target, values, this.gl.STATIC_DRAW);
    this.buffers.push(buffer);
  }

  /** Sets the images of a material when they have arrived; null: it has none. */
  setImages(material: number, base: ImageBitmap | null, normal: ImageBitmap | null): void {
    const images = this.images[material];
    if (!images || !this.loaded) return;
    this.loaded.bitmaps[material] = [base, normal];
    images.base = base && this.texture(base, this.gl.SRGB8_ALPHA8);
    images.normal = normal && this.texture(normal, this.gl.RGBA8);
    images.share = this.fades ? 0 : 1;
    this.fading = this.fades;
    this.onChange();
  }

  private texture(bitmap: ImageBitmap, format: number): WebGLTexture {
    const { gl } = this;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, format, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    const finer = gl.getExtension('EXT_texture_filter_anisotropic');
    if (finer) gl.texParameteri(gl.TEXTURE_2D, finer.TEXTURE_MAX_ANISOTROPY_EXT, 4);
    return texture;
  }

  /** Whether the next picture differs even if the pose does not. */
  get isFading(): boolean {
    return this.fading;
  }

  /** Draws a pose. The canvas must have its size in pixels. `deltaSeconds`: since the last picture, for the fading. */
  draw(pose: Pose, camera: OrbitCamera, deltaSeconds: number): void {
    const { gl, loaded, vertices } = this;
    if (!loaded || !vertices || gl.isContextLost()) return;
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
    const { program, at: uniform } = this.program;
    gl.useProgram(program);
    this.setPose(uniform, pose);
    this.setLight(uniform, camera, sunCamera, radius, at);
    for (const blended of [false, true]) {
      gl.depthMask(!blended);
      if (blended) {
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      }
      for (const { start, count, material } of loaded.mesh.groups) {
        const facts = loaded.materials[material];
        if (!facts || (facts.alpha_mode === 'blend') !== blended) continue;
        this.setMaterial(uniform, facts, this.images[material]!);
        gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, start * 4);
      }
    }
    gl.depthMask(true);
    gl.bindVertexArray(null);
  }

  private drawShadow(pose: Pose, mesh: DrawableMesh, sunCamera: Float32Array): void {
    const { gl } = this;
    const { size } = studioLight.shadow;
    if (this.shadow?.size !== size) this.shadow = this.makeShadow(size);
    // The map must not be bound for reading while it is drawn.
    gl.activeTexture(gl.TEXTURE5);
    gl.bindTexture(gl.TEXTURE_2D, null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadow.target);
    gl.viewport(0, 0, size, size);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    const { program, at } = this.shadowProgram;
    gl.useProgram(program);
    this.setPose(at, pose);
    gl.uniformMatrix4fv(at['camera'] ?? null, false, sunCamera);
    for (const { start, count, material } of mesh.groups) {
      if (this.loaded!.materials[material]?.alpha_mode === 'blend') continue;
      gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, start * 4);
    }
  }

  private makeShadow(size: number): { target: WebGLFramebuffer; map: WebGLTexture; size: number } {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE5);
    const map = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, map);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, size, size);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    const target = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, map, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.activeTexture(gl.TEXTURE0);
    return { target, map, size };
  }

  private setLight(
    uniform: Record<string, WebGLUniformLocation>,
    camera: OrbitCamera,
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
    gl.activeTexture(gl.TEXTURE3);
    gl.bindTexture(gl.TEXTURE_CUBE_MAP, this.environment.radiance);
    gl.activeTexture(gl.TEXTURE4);
    gl.bindTexture(gl.TEXTURE_CUBE_MAP, this.environment.irradiance);
    gl.activeTexture(gl.TEXTURE5);
    this.shadow ??= this.makeShadow(quality.shadows ? shadow.size : 1);
    gl.activeTexture(gl.TEXTURE5);
    gl.bindTexture(gl.TEXTURE_2D, this.shadow.map);
  }

  private setMaterial(uniform: Record<string, WebGLUniformLocation>, facts: RigMaterial, images: Images): void {
    const { gl } = this;
    const set = (name: string): WebGLUniformLocation | null => uniform[name] ?? null;
    const blended = facts.alpha_mode === 'blend';
    const isSkin = this.quality.richSkin && isSkinLike(facts.name, facts.roughness, blended);
    const hasImage = facts.base_color_image !== null;
    const [r, g, b, a] = facts.base_color;
    // Until its image is there, and without one, a plain white material of skin has a skin's colour.
    const bare = Math.min(r, g, b) > whiteLevel && (!hasImage || isSkinLike(facts.name, facts.roughness, blended));
    gl.uniform4f(set('baseColor'), r, g, b, a);
    gl.uniform4fv(set('plainColor'), bare ? [...linear(bareSkinColor), a] : hasImage && blended ? [r, g, b, 0] : [r, g, b, a]);
    gl.uniform1f(set('mapShare'), images.base ? images.share : 0);
    const least = facts.alpha_mode === 'mask' ? facts.alpha_cutoff : blended ? alphaTestOfBlend : 0;
    gl.uniform1f(set('alphaTest'), least);
    gl.uniform1i(set('isOpaque'), blended ? 0 : 1);
    gl.uniform1f(set('roughness'), isSkin ? skinRoughness(facts.roughness) : facts.roughness);
    gl.uniform1f(set('metalness'), isSkin ? 0 : Math.min(facts.metallic, mostMetalness));
    gl.uniform1i(set('isSkin'), isSkin ? 1 : 0);
    gl.uniform1i(set('hasNormalMap'), images.normal ? 1 : 0);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, images.base ?? this.white);
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D, images.normal ?? this.white);
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
    gl.uniform1fv(set('faceLidOpening'), [given[lidFields.opening]!, given[lidFields.count + lidFields.opening]!]);
    for (let side = 0; side < 2; side += 1) {
      const from = side * lidFields.count + lidFields.ball;
      lids.set(given.subarray(from, from + ballPlaces), side * ballPlaces);
    }
    gl.uniform1fv(set('faceLidBall'), lids);
  }

  private releaseFace(): void {
    const { gl } = this;
    for (const buffer of this.buffers) gl.deleteBuffer(buffer);
    for (const { base, normal } of this.images) {
      gl.deleteTexture(base);
      gl.deleteTexture(normal);
    }
    gl.deleteVertexArray(this.vertices);
    gl.deleteTexture(this.entries);
    this.buffers = [];
    this.images = [];
    this.vertices = this.entries = null;
  }

  /** Gives the graphics context back. */
  dispose(): void {
    this.canvas.removeEventListener('webglcontextlost', this.onLost);
    this.canvas.removeEventListener('webglcontextrestored', this.onRestored);
    this.releaseFace();
    this.loaded = null;
    this.gl.getExtension('WEBGL_lose_context')?.loseContext();
  }
}

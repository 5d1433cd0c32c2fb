import { makeEnvironment, type Environment } from './environment.ts';
import { faceFragment, faceVertex, shadowFragment, shadowVertex } from './face_shader.ts';
import { makeProgram, uniformsOf } from './gl.ts';

export interface Program {
  program: WebGLProgram;
  at: Record<string, WebGLUniformLocation>;
}

/** A face that a context draws. */
export interface GraphicsUser {
  /** The context was lost: nothing is drawn until `restored` or `moved`. */
  lost(): void;
  /** The context is back, without anything that the face had in it. */
  restored(): void;
  /** The context does not come back; this one replaces it. */
  moved(next: Graphics): void;
}

/**
 * Contexts whose canvas is in the page. A browser gives a page about 16 contexts, on phones 8, and takes the oldest away for
 * another; the page may need some for itself.
 */
const mostOwn = 4;
/** ms in which a browser gives a context back that was lost with the graphics processor; one of too many it keeps. */
const patience = 1500;

let ownCount = 0;
/** By smoothed edges, which belong to a context. */
const sharedOnes = new Map<boolean, Graphics>();

/** A context that draws into this canvas, or, where there are many, a shared one. Throws when the browser gives no WebGL 2. */
export function graphicsFor(canvas: HTMLCanvasElement, antialias: boolean): Graphics {
  return ownCount < mostOwn ? new Graphics(canvas, antialias, true) : sharedGraphics(antialias);
}

function sharedGraphics(antialias: boolean): Graphics {
  const known = sharedOnes.get(antialias);
  if (known) return known;
  const made = new Graphics(document.createElement('canvas'), antialias, false);
  sharedOnes.set(antialias, made);
  return made;
}

/** A WebGL context, and what all faces in it use: programs, surroundings, the shadow's map. Comes back after a loss. */
export class Graphics {
  readonly gl: WebGL2RenderingContext;
  program!: Program;
  shadowProgram!: Program;
  white!: WebGLTexture;
  private environments = new Map<number, Environment>();
  private shadow: { target: WebGLFramebuffer; map: WebGLTexture; size: number } | null = null;
  /** Of images, which several faces may have; with the number of their uses. */
  private textures: { image: ImageBitmap; format: number; texture: WebGLTexture; uses: number }[] = [];
  private readonly users = new Set<GraphicsUser>();
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly antialias: boolean,
    private readonly isOwn: boolean,
  ) {
    const gl = canvas.getContext('webgl2', { alpha: true, antialias, premultipliedAlpha: true, powerPreference: 'high-performance' });
    if (!gl) throw new Error('WebGL 2 is not available');
    this.gl = gl;
    if (isOwn) ownCount += 1;
    canvas.addEventListener('webglcontextlost', this.onLost);
    canvas.addEventListener('webglcontextrestored', this.onRestored);
    if (!this.isLost) this.start();
  }

  get isLost(): boolean {
    return this.gl.isContextLost();
  }

  add(user: GraphicsUser): void {
    this.users.add(user);
  }

  /** The last one gives the context back. */
  remove(user: GraphicsUser): void {
    this.users.delete(user);
    if (this.users.size === 0) this.dispose();
  }

  /** The image as a texture, which goes back by `dropTexture`. */
  texture(image: ImageBitmap, format: number): WebGLTexture {
    let known = this.textures.find((one) => one.image === image && one.format === format);
    if (!known) this.textures.push((known = { image, format, texture: this.makeTexture(image, format), uses: 0 }));
    known.uses += 1;
    return known.texture;
  }

  dropTexture(texture: WebGLTexture | null): void {
    const known = this.textures.find((one) => one.texture === texture);
    if (!known || --known.uses > 0) return;
    this.gl.deleteTexture(texture);
    this.textures.splice(this.textures.indexOf(known), 1);
  }

  private makeTexture(image: ImageBitmap, format: number): WebGLTexture {
    const { gl } = this;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, format, gl.RGBA, gl.UNSIGNED_BYTE, image);
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    const finer = gl.getExtension('EXT_texture_filter_anisotropic');
    if (finer) gl.texParameteri(gl.TEXTURE_2D, finer.TEXTURE_MAX_ANISOTROPY_EXT, 4);
    return texture;
  }

  /** The surroundings as light. `size`: edge of the cube map, pixels. */
  environment(size: number): Environment {
    let environment = this.environments.get(size);
    if (!environment) {
      this.gl.activeTexture(this.gl.TEXTURE0);
      this.environments.set(size, (environment = makeEnvironment(this.gl, size)));
    }
    return environment;
  }

  /** A map of at least this size, pixels: its depth is that of the face that is drawn. */
  shadowMap(size: number): { target: WebGLFramebuffer; map: WebGLTexture } {
    if (this.shadow && this.shadow.size >= size) return this.shadow;
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE5);
    if (this.shadow) {
      gl.deleteTexture(this.shadow.map);
      gl.deleteFramebuffer(this.shadow.target);
    }
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
    this.shadow = { target, map, size };
    return this.shadow;
  }

  /** To call before a picture for this canvas is drawn, into the first `canvas.width` by `canvas.height` pixels. */
  begin({ width, height }: HTMLCanvasElement): void {
    if (this.isOwn) return;
    if (this.canvas.width < width) this.canvas.width = width;
    if (this.canvas.height < height) this.canvas.height = height;
  }

  /** To call when it is drawn, before the browser goes on. */
  end(canvas: HTMLCanvasElement): void {
    if (this.isOwn) return;
    const { width, height } = canvas;
    const page = canvas.getContext('2d')!;
    page.globalCompositeOperation = 'copy';
    page.drawImage(this.canvas, 0, this.canvas.height - height, width, height, 0, 0, width, height);
  }

  private start(): void {
    const { gl } = this;
    this.environments = new Map();
    this.textures = [];
    this.shadow = null;
    this.program = this.make(faceVertex, faceFragment);
    this.shadowProgram = this.make(shadowVertex, shadowFragment);
    this.white = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.white);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4).fill(255));
  }

  private make(vertex: string, fragment: string): Program {
    const program = makeProgram(this.gl, vertex, fragment);
    return { program, at: uniformsOf(this.gl, program) };
  }

  private readonly onLost = (event: Event): void => {
    event.preventDefault(); // lets the browser give it back
    for (const user of this.users) user.lost();
    this.timer = setTimeout(this.replace, patience);
  };

  private readonly onRestored = (): void => {
    clearTimeout(this.timer);
    this.start();
    for (const user of this.users) user.restored();
  };

  private readonly replace = (): void => {
    if (sharedOnes.get(this.antialias) === this) sharedOnes.delete(this.antialias);
    let next: Graphics;
    try {
      next = sharedGraphics(this.antialias);
    } catch {
      this.timer = setTimeout(this.replace, patience);
      return;
    }
    for (const user of [...this.users]) user.moved(next);
  };

  private dispose(): void {
    clearTimeout(this.timer);
    this.canvas.removeEventListener('webglcontextlost', this.onLost);
    this.canvas.removeEventListener('webglcontextrestored', this.onRestored);
    this.gl.getExtension('WEBGL_lose_context')?.loseContext();
    if (this.isOwn) ownCount -= 1;
    else if (sharedOnes.get(this.antialias) === this) sharedOnes.delete(this.antialias);
  }
}

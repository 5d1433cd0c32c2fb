import {
  Box3,
  Color,
  DirectionalLight,
  HemisphereLight,
  Light,
  NeutralToneMapping,
  PCFShadowMap,
  PerspectiveCamera,
  Scene,
  SRGBColorSpace,
  Vector3,
  Vector4,
  WebGLRenderer,
  type Object3D,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { fieldOfView, studioLight } from '@client/gpu/studio_look.ts';
import { fewerPixels, Pace } from '@client/view/pace.ts';
import { Flight } from './flight.ts';
import { headOfPoints, type Box } from './head_box.ts';
import type { Quality } from './quality.ts';
import { drawRoom, loadRoom, smallRoom } from './room.ts';

export type ViewName = 'front' | 'left' | 'right' | 'three-quarter';

const directions: Record<ViewName, [number, number, number]> = {
  front: [0, 0, 1],
  left: [1, 0, 0.02],
  right: [-1, 0, 0.02],
  'three-quarter': [0.55, 0.06, 0.83],
};

/** Height of the tools and messages at the top and the bottom of the stage, pixels. */
const toolRoom = 124;

/** Time constant by which the camera coasts after a drag, s: 12 % of the rest of the way in each of 60 frames a second. */
const coastTimeConstant = 0.13;

/** Seconds without motion after which the picture gets all its pixels. */
const stillAfter = 0.25;

/** Cosine of the angle up to which two views are from the same side. */
const sameSide = Math.cos(0.6);
/** From this distance on, in radii of the head, the face is smaller than half of the picture. */
const farAway = 2 / Math.tan((fieldOfView * Math.PI) / 360);

const boxFrom = ({ min, max }: Box): Box3 => new Box3(new Vector3(...min), new Vector3(...max));

/** Half the size that a box needs in the picture; the depth counts less, since the head is seen from in front. */
function radiusOf(box: Box3): number {
  const size = box.getSize(new Vector3());
  return Math.max(size.x, size.y, size.z * 0.8) / 2;
}

/** A callback of the frame loop: called once per frame before drawing; returns whether the picture changed. */
export type FrameHook = (deltaSeconds: number) => boolean;

/**
 * The canvas with camera, lights and frame loop. Draws only when something changed. On a device that cannot draw all pixels in
 * time a moving picture has fewer; a still one has them all.
 */
export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(fieldOfView, 1, 0.01, 1000);
  readonly renderer: WebGLRenderer;
  readonly controls: OrbitControls;
  /** Frames drawn in the last full second. */
  framesPerSecond = 0;
  /** Frames drawn so far. */
  drawn = 0;

  private readonly hooks: FrameHook[] = [];
  private readonly center = new Vector3();
  private readonly between = new Vector3();
  private readonly flight = new Flight();
  /** The view before `lookAt` and `lookFrom`, for `lookBack`: the camera's target and the vector from there to the camera. */
  private before: { target: Vector3; arm: Vector3 } | null = null;
  private radius = 1;
  private dirty = true;
  private ended = false;
  private readonly resized = new ResizeObserver(() => this.resize());
  private lastTime = 0;
  private secondStart = 0;
  private framesInSecond = 0;
  private movingPixelRatio: number;
  /** Two steps: one pixel for each of the page, then fewer. The level of detail is the user's choice. */
  private readonly pace = new Pace(['fewer-pixels', 'fewer-pixels']);
  /** Seconds since the camera or the face moved. */
  private rest = stillAfter;
  /** While a video is made. */
  private heldPixelRatio: number | null = null;
  private readonly key = new DirectionalLight(studioLight.key.color, studioLight.key.intensity);
  private readonly rim = new DirectionalLight(studioLight.rim.color, studioLight.rim.intensity);

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly quality: Quality,
  ) {
    this.movingPixelRatio = quality.movingPixelRatio;
    this.renderer = new WebGLRenderer({
      canvas,
      antialias: quality.antialias,
      alpha: true,
      powerPreference: 'high-performance',
    });
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.toneMappingExposure = 1;
    this.renderer.shadowMap.enabled = quality.shadows;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.setClearColor(new Color(0), 0);

    this.scene.environmentIntensity = studioLight.environment;
    if (quality.roomSize === smallRoom) void this.loadEnvironment();
    else this.drawEnvironment();
    // A phone takes the graphics context from a page in the background. three.js uploads meshes and textures again, but
    // not what was drawn into a texture.
    canvas.addEventListener('webglcontextrestored', () => {
      if (this.scene.environment?.isRenderTargetTexture) this.drawEnvironment();
      this.invalidate();
    });

    const { sky, ground, intensity } = studioLight.hemisphere;
    this.scene.add(new HemisphereLight(sky, ground, intensity), this.key, this.key.target, this.rim, this.rim.target);

    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.moved());
    this.controls.addEventListener('start', () => this.flight.stop());

    this.resized.observe(canvas.parentElement ?? canvas);
    this.resize();
    requestAnimationFrame(this.frame);
  }

  /** Requests one more drawn frame. */
  invalidate(): void {
    this.dirty = true;
  }

  /** Half the size of what `frameObject` framed, model units. */
  get headRadius(): number {
    return this.radius;
  }

  /** Keeps the number of pixels of a moving picture, or no longer: a video has one size. */
  holdSize(holds: boolean): void {
    this.heldPixelRatio = null;
    if (holds) {
      this.rest = 0;
      this.heldPixelRatio = this.pixelRatio;
    }
    this.fitPixels();
  }

  onFrame(hook: FrameHook): void {
    this.hooks.push(hook);
  }

  /** The present picture as PNG, without the page's background. The canvas keeps what was drawn only within one task. */
  picture(): Promise<Blob | null> {
    this.rest = stillAfter;
    this.fitPixels();
    this.renderer.render(this.scene, this.camera);
    return new Promise((resolve) => this.canvas.toBlob(resolve, 'image/png'));
  }

  /** A colour behind the head as CSS has it, for videos, which have no transparency; null: none, the page is seen through. */
  setBackdrop(colour: string | null): void {
    this.renderer.setClearColor(new Color(colour ?? 0), colour === null ? 0 : 1);
    this.invalidate();
  }

  /** Fits camera and lights to an object, or to the head that is a part of it, and shows it from this side. */
  frameObject(object: Object3D, head: Box | null, view: ViewName): void {
    const whole = new Box3().setFromObject(object);
    if (whole.isEmpty()) return;
    this.aim(head ? boxFrom(head) : whole);
    const reach = radiusOf(whole);
    this.camera.near = this.radius / 50;
    this.camera.far = reach * 60;
    this.controls.minDistance = this.radius * 0.3;
    this.controls.maxDistance = reach * 14;
    this.look(view, true);
  }

  /** Fits the middle and the lights to a box. */
  private aim(box: Box3): void {
    box.getCenter(this.center);
    this.radius = radiusOf(box);
    this.placeLights();
  }

  /** What is framed: the height of its middle, and half its size, model units. */
  get framed(): { height: number; radius: number } {
    return { height: this.center.y, radius: this.radius };
  }

  /** From now on shows this part of the framed object as the head. */
  frameHead(head: Box, view: ViewName): void {
    this.aim(boxFrom(head));
    this.camera.near = this.radius / 50;
    this.controls.minDistance = this.radius * 0.3;
    this.look(view);
  }

  /** Shows the whole face again, from where the camera is. */
  frameFace(): void {
    this.before = null;
    this.fly(this.center, this.radius * 1.06, this.arm(), false);
  }

  /** Brings a place to the middle of the picture, and nearer, from where the camera is. */
  focus(place: readonly [number, number, number]): void {
    this.fly(new Vector3(...place), this.radius * 0.45, this.arm(), false);
  }

  look(view: ViewName, atOnce = false): void {
    this.before = null;
    this.fly(this.center, this.radius * 1.06, new Vector3(...directions[view]), atOnce);
  }

  /** Moves the camera to a place of the model so that a ball of `radius` fits; `outward`: the surface normal there. */
  lookAt(place: Vector3, radius: number, outward: Vector3): void {
    this.remember();
    // The mean of the normal and the front: no view from below or behind because of one triangle's normal.
    const direction = outward
      .clone()
      .normalize()
      .add(new Vector3(0, 0, 0.6));
    direction.y *= 0.5;
    if (direction.lengthSq() < 0.05) direction.set(0.3, 0, 1);
    this.fly(place, Math.max(radius, this.radius * 0.4), direction, false);
  }

  /** Shows the whole face from a side, unless the camera is on that side already; `lookBack` restores the view before. */
  lookFrom(view: ViewName): void {
    const side = new Vector3(...directions[view]).normalize();
    if (this.arm().normalize().dot(side) > sameSide && this.arm().length() < this.radius * farAway) return;
    this.remember();
    this.fly(this.center, this.radius * 1.06, side, false);
  }

  private remember(): void {
    this.before ??= { target: this.controls.target.clone(), arm: this.arm() };
  }

  /** Restores the view before `lookAt` and `lookFrom`. */
  lookBack(): void {
    if (!this.before) return;
    const { target, arm } = this.before;
    this.before = null;
    this.start(target, arm, false);
  }

  /** The vector from what the camera looks at to the camera. */
  private arm(): Vector3 {
    return this.camera.position.clone().sub(this.controls.target);
  }

  private fly(target: Vector3, radius: number, direction: Vector3, atOnce: boolean): void {
    const half = (this.camera.fov * Math.PI) / 360;
    // Leave space for the tools that float above and below the head.
    const height = this.canvas.clientHeight;
    const free = Math.max(0.6, (height - toolRoom) / Math.max(height, 1));
    const narrow = Math.min(1, this.camera.aspect * 1.3);
    const distance = radius / Math.tan(half) / (free * narrow);
    this.start(target, direction.normalize().multiplyScalar(distance), atOnce);
  }

  private start(target: Vector3, arm: Vector3, atOnce: boolean): void {
    this.flight.start(this.camera, this.controls.target, target, arm);
    if (atOnce || window.matchMedia('(prefers-reduced-motion: reduce)').matches) {
      this.flight.arrive(this.camera, this.controls.target);
      this.camera.updateProjectionMatrix();
      this.controls.update();
      // A click may arrive before the next drawn frame: picking must use the camera of that frame.
      this.camera.updateMatrixWorld();
    }
    this.invalidate();
  }

  /** Sees the framed head as another stage sees its own: from the same side, equally large. Allocates nothing. */
  copyView(from: Stage): void {
    this.flight.stop();
    const scale = this.radius / from.radius;
    this.controls.target.copy(from.controls.target).sub(from.center).multiplyScalar(scale).add(this.center);
    this.camera.position.copy(from.camera.position).sub(from.center).multiplyScalar(scale).add(this.center);
    this.camera.quaternion.copy(from.camera.quaternion);
    this.invalidate();
  }

  /** Whether `copyView` would move the camera by more than rounding. Allocates nothing. */
  seesOtherThan(from: Stage): boolean {
    const scale = this.radius / from.radius;
    const { center, controls, camera, between } = this;
    const tolerance = this.radius * 1e-5;
    between.copy(from.controls.target).sub(from.center).multiplyScalar(scale).add(center);
    if (between.distanceTo(controls.target) > tolerance) return true;
    between.copy(from.camera.position).sub(from.center).multiplyScalar(scale).add(center);
    return between.distanceTo(camera.position) > tolerance;
  }

  /** Ends the frame loop and gives the graphics context back. */
  dispose(): void {
    this.ended = true;
    this.resized.disconnect();
    this.controls.dispose();
    this.scene.environment?.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  /** Rotates the camera around the head, for the keyboard. Angles in radians. */
  orbit(yaw: number, pitch: number): void {
    this.flight.stop();
    const arm = this.arm();
    arm.applyAxisAngle(new Vector3(0, 1, 0), yaw);
    const side = new Vector3().crossVectors(this.camera.up, arm).normalize();
    const tilted = arm.clone().applyAxisAngle(side, pitch);
    if (Math.abs(tilted.clone().normalize().y) < 0.97) arm.copy(tilted);
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
    this.invalidate();
  }

  /** Moves the camera's target parallel to the screen, in fractions of the picture's height; for the keyboard. */
  pan(right: number, up: number): void {
    this.flight.stop();
    const arm = this.arm();
    const height = 2 * arm.length() * Math.tan((this.camera.fov * Math.PI) / 360);
    const side = new Vector3().crossVectors(this.camera.up, arm).normalize();
    const above = new Vector3().crossVectors(arm, side).normalize();
    const step = side.multiplyScalar(right * height).add(above.multiplyScalar(up * height));
    this.controls.target.add(step);
    this.camera.position.add(step);
    this.controls.update();
    this.invalidate();
  }

  /** Moves the camera nearer (`factor` below 1) or farther; `place`: of the surface at the middle of the picture, where it then stays outside. */
  zoom(factor: number, place: readonly [number, number, number] | null = null): void {
    this.flight.stop();
    if (place) {
      // The target moves along the view only, so that the picture does not jump.
      const arm = this.arm();
      const depth = this.between.set(...place).sub(this.controls.target).dot(arm) / arm.lengthSq();
      this.controls.target.addScaledVector(arm, Math.min(depth, 0.9));
    }
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.invalidate();
  }

  /**
   * A small image of the face from in front, as a data URL, for the shelf. To be taken in a frame hook: the picture of the stage, whose
   * camera stays where it is, is drawn over it before anybody sees it.
   */
  thumbnail(size: number): string {
    const { renderer, camera } = this;
    const from = renderer.domElement;
    const side = Math.min(size, from.width, from.height);
    const front = camera.clone();
    front.aspect = 1;
    front.near = this.radius / 50;
    front.far = this.radius * 60;
    front.updateProjectionMatrix();
    front.position.copy(this.center).add(new Vector3(0, 0, (this.radius * 1.06) / Math.tan((camera.fov * Math.PI) / 360)));
    front.lookAt(this.center);
    const whole = renderer.getViewport(new Vector4());
    const ratio = renderer.getPixelRatio();
    renderer.setViewport(0, 0, side / ratio, side / ratio); // no more pixels than the image has
    renderer.render(this.scene, front);
    renderer.setViewport(whole);
    this.invalidate();
    const to = document.createElement('canvas');
    to.width = to.height = size;
    to.getContext('2d')?.drawImage(from, 0, from.height - side, side, side, 0, 0, size, size);
    return to.toDataURL('image/webp', 0.8);
  }

  /** The same of an object that is not on the stage; `head`: the part of it that is the head, `points`: its feature points. */
  portrait(object: Object3D, { head, points }: { head: Box | null; points: readonly (readonly [number, number, number])[] }, size: number): string {
    const hidden = this.scene.children.filter((child) => child.visible && !(child instanceof Light));
    const middle = this.center.clone();
    const { radius } = this;
    for (const child of hidden) child.visible = false;
    this.scene.add(object);
    this.aim(head ? boxFrom(head) : new Box3().setFromObject(object));
    const told = headOfPoints(points, this.framed);
    if (told) this.aim(boxFrom(told));
    const image = this.thumbnail(size);
    this.center.copy(middle);
    this.radius = radius;
    this.placeLights();
    object.removeFromParent();
    for (const child of hidden) child.visible = true;
    return image;
  }

  /** Draws the surroundings that light the head, once per graphics context. */
  private drawEnvironment(): void {
    this.scene.environment?.dispose();
    this.scene.environment = drawRoom(this.renderer, this.quality.roomSize);
  }

  /** Loads them; what is drawn waits for them, as each material's program is another without. */
  private async loadEnvironment(): Promise<void> {
    try {
      const room = await loadRoom();
      if (this.ended) room.dispose();
      else this.scene.environment = room;
    } catch {
      if (!this.ended) this.drawEnvironment(); // the network, or an older server
    }
    this.invalidate();
  }

  private placeLights(): void {
    const { center: c, radius: r } = this;
    for (const [light, place] of [
      [this.key, studioLight.key.place],
      [this.rim, studioLight.rim.place],
    ] as const) {
      light.position.set(place[0], place[1], place[2]).multiplyScalar(r).add(c);
    }
    this.key.target.position.copy(c);
    this.rim.target.position.copy(c);
    this.key.castShadow = this.quality.shadows;
    const shadow = this.key.shadow;
    const look = studioLight.shadow;
    shadow.mapSize.set(look.size, look.size);
    shadow.radius = look.softness;
    shadow.intensity = look.intensity;
    shadow.bias = -look.bias;
    shadow.normalBias = r * look.normalBias;
    const camera = shadow.camera;
    camera.left = camera.bottom = -r * look.reach;
    camera.right = camera.top = r * look.reach;
    camera.near = r * look.near;
    camera.far = r * look.far;
    camera.updateProjectionMatrix();
  }

  private resize(): void {
    const holder = this.canvas.parentElement ?? this.canvas;
    const width = Math.max(1, holder.clientWidth);
    const height = Math.max(1, holder.clientHeight);
    this.renderer.setPixelRatio(this.pixelRatio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.invalidate();
  }

  private moved(): void {
    this.rest = 0;
    this.invalidate();
  }

  private get pixelRatio(): number {
    if (this.heldPixelRatio !== null) return this.heldPixelRatio;
    const { maxPixelRatio } = this.quality;
    return Math.min(window.devicePixelRatio, this.rest < stillAfter ? this.movingPixelRatio : maxPixelRatio);
  }

  /** Gives the canvas as many pixels as a picture has that moves, or is still. */
  private fitPixels(): void {
    if (this.renderer.getPixelRatio() !== this.pixelRatio) this.resize();
  }

  private readonly frame = (time: number): void => {
    if (this.ended) return;
    requestAnimationFrame(this.frame); // first: an exception below must not end the loop
    const passed = (time - this.lastTime) / 1000;
    const delta = Math.min(0.1, passed);
    this.lastTime = time;
    this.rest += passed;
    if (this.flight.flying) {
      this.flight.step(this.camera, this.controls.target, delta);
      this.moved();
    }
    this.controls.dampingFactor = 1 - Math.exp(-delta / coastTimeConstant); // by time: seldom drawn, it would coast for many seconds
    this.controls.update();
    let moves = false;
    for (let i = 0; i < this.hooks.length; i += 1) moves = this.hooks[i]!(delta) || moves; // an iterator would be allocated
    if (moves) this.moved();
    if (this.rest === 0 && this.pace.tick(passed, 0, false, false))
      this.movingPixelRatio = fewerPixels(this.renderer.getPixelRatio());
    this.fitPixels();
    if (this.dirty && this.scene.environment) {
      this.dirty = false;
      this.renderer.render(this.scene, this.camera);
      this.framesInSecond += 1;
      this.drawn += 1;
    }
    if (time - this.secondStart >= 1000) {
      this.framesPerSecond = Math.round((this.framesInSecond * 1000) / (time - this.secondStart));
      this.framesInSecond = 0;
      this.secondStart = time;
    }
  };
}

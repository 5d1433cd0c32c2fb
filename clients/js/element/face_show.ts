import { loadDraco } from '../draco/index.ts';
import type { Face, LoadOptions } from '../face.ts';
import { drawableMesh, type DrawableMesh } from '../gpu/drawable_mesh.ts';
import { Kernel } from '../kernel.ts';
import { Player, shownPose } from '../player.ts';
import { Emitter } from '../emitter.ts';
import { OrbitCamera } from '../view/camera.ts';
import { FaceRenderer, type RenderQuality } from '../view/face_renderer.ts';
import { frameOf, type Fit } from '../view/framing.ts';
import { fewerPixels, Pace, type Step } from '../view/pace.ts';
import { loadRuntime } from '../wasm.ts';
import { budgetOf, cheaperSteps, firstVertices, thisDevice, type Budget, type QualityName } from './detail.ts';
import type { Cue, StreamCaptions } from '../captions/index.ts';
import type { StreamSound } from '../sound/index.ts';
import type { StreamSpeech } from '../speech/index.ts';
import { Link } from './link.ts';
import { faceOf, Images, modelOf, firstImages, smallImages, trouble, type Source } from './loader.ts';
import { FaceTrouble, isPassing } from './words.ts';

/** `resting`: drawn and not moving yet, or paused. `stalled`: without a connection. */
export type ShowState = 'loading' | 'resting' | 'playing' | 'stalled' | 'ended' | 'error';

export interface ShowEvents {
  state: ShowState;
  /** The first picture is drawn. */
  ready: void;
  /** The face moves, first or again. */
  playing: void;
  level: { lod: number; vertices: number };
  trouble: FaceTrouble | null;
  /** The stream has sound or not, or it is heard or not; the same of the browser's own voice. */
  sound: void;
  /** Other words are said in the picture that is shown; null: none. */
  cue: Cue | null;
}

export interface ShowOptions {
  source: Source;
  fit: Fit;
  quality: QualityName;
  /** Whether colours fade in; not where less motion is wished. */
  fades: boolean;
  paused: boolean;
  /** Whether the sound is asked for; it is heard after `setSound`. */
  sound: boolean;
  /** Whether the browser's own voice may speak in place of the stream's sound, after `setVoice`. */
  voice: boolean;
}

/** ms until the next attempt after a trouble that can pass; each attempt doubles it, up to the longest. */
const firstRetry = 1000;
const longestRetry = 10_000;
/** ms that the first picture waits for images that are late: the small ones, and all of a face that stands still */
const imagePatience = 1500;
/** ms after which a face that is not seen leaves the graphics card */
const awayPatience = 5000;

/** Of faces that several elements of the page show. */
const meshes = new WeakMap<Face, DrawableMesh>();
/** Name of the page's graphics processor, once it was asked for. */
let graphicsName: string | undefined;

/** One face on the page: loads it, follows its stream, draws it, keeps the device's pace, and comes back after a loss. */
export class FaceShow extends Emitter<ShowEvents> {
  state: ShowState = 'loading';
  trouble: FaceTrouble | null = null;
  readonly camera = new OrbitCamera();
  link: Link;
  face: Face | null = null;
  /** Follows the stream while the face is still loading. */
  readonly player: Player = new Player(null, {
    clock: () => this.sound?.mediaTime ?? NaN,
    overlay: (runtime, frame) => this.speech?.show(runtime, frame) ?? false,
  });
  /** Pictures drawn in the last second in which the face moved. */
  framesPerSecond = 0;

  private sound: StreamSound | null = null;
  private speech: StreamSpeech | null = null;
  private captions: StreamCaptions | null = null;
  private roomBelow = (): number => 0;
  private readonly renderer: FaceRenderer;
  private render: RenderQuality;
  private readonly budget: Budget;
  private readonly pace: Pace;
  private readonly images: Images;
  private readonly work = new AbortController();
  private kernel: Kernel | null = null;
  private model = '';
  private paused: boolean;
  private visible = true;
  private dirty = true;
  private played = false;
  private loadingLevel = false;
  private lastTime = 0;
  private busy = 0;
  private second = { start: 0, frames: 0 };
  private attempts = 0;
  private retryTimer: ReturnType<typeof setTimeout> | undefined;
  private awayTimer: ReturnType<typeof setTimeout> | undefined;
  private frameRequest = 0;
  /** Begins with the images that the first picture did not wait for. */
  private fillLarge: () => void = () => undefined;
  private readonly resized: ResizeObserver;
  /** Where the face is shown: a page can move it to another window, whose pictures go on while the page is hidden. */
  private readonly page: Document;
  private readonly window: Window & typeof globalThis;

  /** Throws FaceTrouble where WebGL 2 is missing. */
  constructor(
    private readonly stage: HTMLElement,
    private options: ShowOptions,
  ) {
    super();
    this.page = stage.ownerDocument;
    this.window = this.page.defaultView!;
    this.paused = options.paused;
    this.budget = budgetOf(thisDevice((graphicsName ??= rendererName())), options.quality);
    this.render = this.budget.render;
    this.pace = new Pace(cheaperSteps(this.render, this.window.devicePixelRatio || 1));
    try {
      this.renderer = new FaceRenderer(stage, this.render, options.fades);
    } catch {
      throw trouble('no-webgl');
    }
    this.renderer.onChange = () => {
      this.invalidate();
      this.settle();
    };
    this.images = new Images(options.source, options.paused);
    this.link = this.follow();
    for (const name of ['online', 'pageshow', 'focus']) this.window.addEventListener(name, this.check);
    this.page.addEventListener('visibilitychange', this.check);
    this.resized = new this.window.ResizeObserver(() => this.resize());
    this.resized.observe(stage);
    this.resize();
    this.link.open();
    void this.load();
    this.frameRequest = this.window.requestAnimationFrame(this.frame);
  }

  private follow(): Link {
    const link = new Link(this.options.source, this.options.sound);
    link.client.on('header', () => this.emit('sound', undefined));
    this.player.follow(link.client);
    link.on('state', () => this.takeLink());
    return link;
  }

  /** Connects to the stream anew. The face stays, and what was heard, said or shown in words goes on. */
  private followAgain(): void {
    const { isHeard, isSpeaking, sound, speech, captions } = this;
    sound?.dispose();
    speech?.dispose();
    captions?.dispose();
    this.sound = this.speech = this.captions = null;
    this.link.close();
    this.link = this.follow();
    this.link.open();
    const begin = (start: Promise<void>): void => void start.catch(() => this.emit('sound', undefined));
    if (isHeard && this.options.sound) begin(this.setSound(true));
    if (isSpeaking) begin(this.setVoice(true));
    if (captions?.isOn) begin(this.setCaptions(true, this.roomBelow));
    this.emit('sound', undefined);
    this.settle();
  }

  /** A face that is drawn stays, whatever the server says to the other token. */
  setToken(token: string | null): void {
    const source = { ...this.options.source, token };
    this.options = { ...this.options, source };
    this.images.source = source;
    this.followAgain();
    this.retry(0);
  }

  /** Whether the sound is asked for: servers are told when a connection begins. */
  askSound(asks: boolean): void {
    if (asks === this.options.sound) return;
    this.options = { ...this.options, sound: asks };
    this.followAgain();
  }

  /** Whether the browser's own voice may speak, after `setVoice`. */
  offerVoice(offers: boolean): void {
    this.options = { ...this.options, voice: offers };
    if (!offers) this.speech?.stop();
    this.emit('sound', undefined);
  }

  /** Draws only while it is seen; the graphics card keeps a face a little longer. */
  setVisible(visible: boolean): void {
    this.visible = visible;
    clearTimeout(this.awayTimer);
    if (!visible) this.awayTimer = setTimeout(() => this.renderer.setAway(true), awayPatience);
    else this.renderer.setAway(false);
    this.invalidate();
  }

  setPaused(paused: boolean): void {
    this.paused = paused;
    this.played = false; // the next motion is announced again
    this.settle();
  }

  get hasSound(): boolean {
    return this.link.client.header?.sound?.codec === 'opus';
  }

  get isHeard(): boolean {
    return this.sound?.isOn ?? false;
  }

  /** To call by a tap. Rejects where the browser does not allow sound. */
  async setSound(on: boolean): Promise<void> {
    // What decodes and plays is fetched by those who listen.
    const { StreamSound } = await import('../sound/index.ts');
    if (this.work.signal.aborted) return;
    if (on) await (this.sound ??= new StreamSound(this.link.client, this.player)).start();
    else await this.sound?.stop();
    this.emit('sound', undefined);
  }

  /** Whether the browser has a voice, as far as is known: `setVoice` finds out. */
  get hasVoice(): boolean {
    return this.options.voice && typeof speechSynthesis === 'object' && this.speech?.state !== 'failed';
  }

  get isSpeaking(): boolean {
    return this.speech?.state === 'ready';
  }

  /** To call by a tap. The text of the stream is said by the browser's own voice; where it has none, frames and sound stay. */
  async setVoice(on: boolean): Promise<void> {
    const { StreamSpeech } = await import('../speech/index.ts');
    if (this.work.signal.aborted) return;
    if (!this.speech) {
      this.speech = new StreamSpeech(this.link.client, () => this.player.delay);
      this.speech.on('state', () => this.emit('sound', undefined));
    }
    if (on) await this.speech.start();
    else this.speech.stop();
  }

  /** Whether what is said is told, by `cue`. `room`: px at the lower edge that the face leaves free for it. */
  async setCaptions(on: boolean, room: () => number): Promise<void> {
    this.roomBelow = on ? room : () => 0;
    this.resize();
    if (!on) return this.captions?.stop();
    const { StreamCaptions } = await import('../captions/index.ts');
    if (this.work.signal.aborted) return;
    if (!this.captions) {
      this.captions = new StreamCaptions(this.link.client, () => this.shownTime);
      this.captions.on('cue', (cue) => this.emit('cue', cue));
    }
    this.captions.start();
  }

  /** ms of the stream's clock: what is heard, else what is seen. */
  private get shownTime(): number {
    const heard = this.sound?.mediaTime ?? NaN;
    return Number.isFinite(heard) ? heard : this.link.client.streamClock.mediaTime - this.player.delay;
  }

  setFit(fit: Fit): void {
    this.options = { ...this.options, fit };
    if (this.face) this.camera.subject = frameOf(this.face.rig, fit);
    this.invalidate();
  }

  invalidate(): void {
    this.dirty = true;
  }

  close(): void {
    this.work.abort();
    this.window.cancelAnimationFrame(this.frameRequest);
    clearTimeout(this.retryTimer);
    clearTimeout(this.awayTimer);
    for (const name of ['online', 'pageshow', 'focus']) this.window.removeEventListener(name, this.check);
    this.page.removeEventListener('visibilitychange', this.check);
    this.resized.disconnect();
    this.sound?.dispose();
    this.speech?.dispose();
    this.captions?.dispose();
    this.link.close();
    this.player.dispose();
    this.kernel?.dispose();
    this.renderer.dispose();
  }

  private readonly check = (): void => {
    if (this.page.visibilityState === 'hidden') return;
    this.link.check();
    if (this.retryTimer !== undefined) this.retry(0);
  };

  private async load(): Promise<void> {
    const { signal } = this.work;
    const { source } = this.options;
    const libraries = { draco: loadDraco(), runtime: loadRuntime() };
    try {
      const model = await modelOf(source, signal);
      if (model !== this.model) {
        const level = { maxVertices: Math.min(firstVertices, this.budget.maxVertices) };
        const face = await faceOf(source, model, libraries, level, this.images, signal);
        const wanted = firstImages(face.rig.images, this.paused).map(({ sha256 }) => this.images.get(sha256));
        await Promise.race([Promise.allSettled(wanted), new Promise((wake) => setTimeout(wake, imagePatience))]);
        if (signal.aborted || source !== this.options.source) return;
        const kernel = new Kernel(await libraries.runtime, face, { withVertices: false });
        this.kernel?.dispose();
        this.model = model;
        this.kernel = kernel;
        this.show(face);
        this.camera.subject = frameOf(face.rig, this.options.fit);
        this.player.show(kernel);
        this.emit('ready', undefined);
      }
      if (source !== this.options.source) return;
      this.attempts = 0;
      this.setTrouble(null);
      this.settle();
      if (this.link.state === 'ended') this.link.open();
    } catch (error) {
      if (signal.aborted || source !== this.options.source) return; // of a token that was replaced
      const cause = error instanceof FaceTrouble ? error : trouble('unreachable');
      this.setTrouble(cause);
      if (isPassing(cause.code)) this.retry(Math.min(longestRetry, firstRetry * 2 ** this.attempts++));
    }
  }

  private retry(pause: number): void {
    clearTimeout(this.retryTimer);
    this.retryTimer = setTimeout(() => {
      this.retryTimer = undefined;
      void this.load();
    }, pause);
  }

  private show(face: Face): void {
    this.face = face;
    let mesh = meshes.get(face);
    if (!mesh) meshes.set(face, (mesh = drawableMesh(face)));
    this.renderer.setFace(mesh, face.rig.materials);
    const wanted = face.rig.materials.map(({ base_color_image, normal_image }) => [base_color_image, normal_image] as const);
    const first = new Set(smallImages(face.rig.images).map(({ sha256 }) => sha256));
    const fill = (choose: (sha256: string) => boolean): void =>
      wanted.forEach((hashes, i) => {
        const named = hashes.filter((hash) => hash !== null);
        if (named.length === 0 || !choose(named[0]!)) return;
        void Promise.all(hashes.map((hash) => (hash === null ? null : this.images.get(hash))))
          .then(([base, normal]) => {
            if (this.face === face) this.renderer.setImages(i, base ?? null, normal ?? null);
          })
          .catch(() => undefined); // the plain colour stays
      });
    fill((hash) => first.has(hash));
    // The large ones must not keep the face from moving: they begin with its first motion, or when none comes.
    let isDone = false;
    this.fillLarge = () => {
      if (isDone || this.work.signal.aborted) return;
      isDone = true;
      fill((hash) => !first.has(hash));
    };
    if (this.played || this.paused) this.fillLarge();
    else setTimeout(this.fillLarge, imagePatience);
    this.invalidate();
    this.emit('level', { lod: face.rig.lod, vertices: face.rig.mesh.vertices });
  }

  private takeLink(): void {
    if (this.link.state === 'lost') this.retry(firstRetry); // learns why
    if (this.link.state === 'ended') {
      this.attempts = 2;
      this.retry(firstRetry * 4);
    }
    this.settle();
  }

  private setTrouble(cause: FaceTrouble | null): void {
    if (cause?.code === this.trouble?.code) return;
    this.trouble = cause;
    this.emit('trouble', cause);
    this.settle();
  }

  /** Computes the state from what is known. */
  private settle(): void {
    const { link } = this;
    const state: ShowState =
      this.trouble !== null && this.face === null
        ? 'error'
        : this.face === null || this.renderer.isLost
          ? 'loading'
          : link.state === 'ended'
            ? 'ended'
            : link.state === 'lost'
              ? 'stalled'
              : this.played && !this.paused
                ? 'playing'
                : 'resting';
    if (state === this.state) return;
    this.state = state;
    this.emit('state', state);
  }

  private readonly frame = (time: number): void => {
    this.frameRequest = this.window.requestAnimationFrame(this.frame); // first: an exception below must not end the loop
    const delta = Math.min(0.5, (time - this.lastTime) / 1000);
    this.lastTime = time;
    if (!this.visible || !this.kernel) return;
    const begun = performance.now();
    this.captions?.update();
    const moved = !this.paused && this.player.update(delta);
    if (moved || this.dirty || this.renderer.isFading) {
      this.dirty = false;
      this.renderer.draw(this.kernel.poses[shownPose]!, this.camera, delta);
    }
    if (!moved || this.renderer.isLost) return;
    if (!this.played) {
      this.played = true;
      this.fillLarge();
      this.emit('playing', undefined);
      this.settle();
    }
    this.busy += (performance.now() - begun - this.busy) * 0.1;
    this.count(time);
    const levels = this.face?.rig.levels ?? [];
    const lod = this.face?.rig.lod ?? 0;
    const hasLarger = lod > 0 && (levels[lod - 1]?.vertices ?? Infinity) <= this.budget.maxVertices;
    const step = this.pace.tick(delta, this.busy / 1000, lod + 1 < levels.length, hasLarger);
    if (step) this.take(step, lod);
  };

  private count(time: number): void {
    this.second.frames += 1;
    const passed = time - this.second.start;
    if (passed < 1000) return;
    if (passed < 2000) this.framesPerSecond = (this.second.frames * 1000) / passed;
    this.second = { start: time, frames: 0 };
  }

  private take(step: Step, lod: number): void {
    if (step === 'fewer-pixels') this.render = { ...this.render, maxPixelRatio: fewerPixels(this.pixelRatio) };
    if (step === 'plainer') this.render = { ...this.render, shadows: false, richSkin: false };
    if (step === 'fewer-pixels' || step === 'plainer') {
      this.renderer.setQuality(this.render);
      return this.resize();
    }
    void this.changeLevel({ lod: step === 'larger' ? lod - 1 : lod + 1 });
  }

  private async changeLevel(level: NonNullable<LoadOptions['level']>): Promise<void> {
    if (this.loadingLevel) return;
    this.loadingLevel = true;
    try {
      const libraries = { draco: loadDraco(), runtime: loadRuntime() };
      const face = await faceOf(this.options.source, this.model, libraries, level, this.images, this.work.signal);
      // The poses are the same for all levels, so the kernel and its player stay.
      this.show(face);
    } catch {
      // The level that is shown stays; the pace will ask again.
    } finally {
      this.loadingLevel = false;
    }
  }

  /** Drawn pixels for each pixel of the page, along a side. */
  private get pixelRatio(): number {
    return Math.min(this.window.devicePixelRatio || 1, this.render.maxPixelRatio);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.stage;
    this.camera.room = Math.min(0.4, this.roomBelow() / Math.max(1, clientHeight));
    const pixels = (length: number): number => Math.max(1, Math.round(length * this.pixelRatio));
    this.renderer.resize(pixels(clientWidth), pixels(clientHeight));
  }
}

/** Name of the graphics processor; empty where the browser does not tell it. */
function rendererName(): string {
  const gl = document.createElement('canvas').getContext('webgl2');
  const facts = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = gl && facts ? String(gl.getParameter(facts.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return name;
}

import type { CaptionsBox, Cue } from '../captions/index.ts';
import type { OrbitCamera } from '../view/camera.ts';
import { FaceAttributesElement } from './attributes.ts';
import { FaceShow, type ShowState } from './face_show.ts';
import { turnByFingers, turnOfKey } from './gestures.ts';
import { expectIds, serverOf, trouble, type Source } from './loader.ts';
import { styleText } from './style.ts';
import { FaceTrouble, faceWords, type Trouble } from './words.ts';

export type FaceState = ShowState | 'idle';

/** How good the connection is. */
export type Connection = 'none' | 'good' | 'fair' | 'poor' | 'lost';

/** Loading begins this far before the element is scrolled into view. */
const ahead = '200px';

/** By document and text: a document takes only sheets of its own, and drops those of another when an element comes from there. */
const sheets = new WeakMap<Document, Map<string, CSSStyleSheet>>();

function sheetOf(page: Document, text: string): CSSStyleSheet {
  const ofPage = sheets.get(page) ?? new Map<string, CSSStyleSheet>();
  sheets.set(page, ofPage);
  let sheet = ofPage.get(text);
  if (!sheet) {
    ofPage.set(text, (sheet = new page.defaultView!.CSSStyleSheet()));
    sheet.replaceSync(text);
  }
  return sheet;
}

/** Events of the element. */
export interface FaceEventMap {
  ready: CustomEvent<null>;
  playing: CustomEvent<null>;
  stalled: CustomEvent<null>;
  ended: CustomEvent<null>;
  error: CustomEvent<{ code: Trouble; message: string }>;
  levelchange: CustomEvent<{ lod: number; vertices: number }>;
  /** With captions: other words are said; empty: none. */
  cuechange: CustomEvent<{ text: string; language: string }>;
  statechange: CustomEvent<{ state: FaceState; message: string }>;
}

type OtherEvents = Omit<HTMLElementEventMap, keyof FaceEventMap>;

/** Declarations alone: the types of the events for those who listen. */
export interface SemblanteFace {
  addEventListener<Name extends keyof FaceEventMap>(type: Name, listener: (this: SemblanteFace, event: FaceEventMap[Name]) => unknown, options?: boolean | AddEventListenerOptions): void;
  addEventListener<Name extends keyof OtherEvents>(type: Name, listener: (this: SemblanteFace, event: OtherEvents[Name]) => unknown, options?: boolean | AddEventListenerOptions): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
  removeEventListener<Name extends keyof FaceEventMap>(type: Name, listener: (this: SemblanteFace, event: FaceEventMap[Name]) => unknown, options?: boolean | EventListenerOptions): void;
  removeEventListener<Name extends keyof OtherEvents>(type: Name, listener: (this: SemblanteFace, event: OtherEvents[Name]) => unknown, options?: boolean | EventListenerOptions): void;
  removeEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | EventListenerOptions): void;
}

/**
 * `<semblante-face src stream>`: a face that follows a stream. README.md lists attributes, properties, methods and
 * events.
 */
export class SemblanteFace extends FaceAttributesElement {
  static readonly observedAttributes = ['src', 'stream', 'model', 'fit', 'quality', 'poster', 'alt', 'sound', 'voice', 'captions'];

  private show: FaceShow | null = null;
  private failed: FaceTrouble | null = null;
  private secret: string | null = null;
  private paused_: boolean | null = null;
  private seen: IntersectionObserver | null = null;
  private inView = false;
  /** Holds what shows the face. */
  private stage: HTMLElement | null = null;
  private readonly picture = this.make('img');
  private readonly words = this.make('p');
  private readonly wheel = this.make('i');
  private readonly playButton = this.make('button');
  private readonly soundButton = this.make('button');
  private captionsBox: CaptionsBox | null = null;
  private readonly styles = [styleText];
  /** The document that shows it. */
  private page: Document | null = null;

  constructor() {
    super();
    const root = this.attachShadow({ mode: 'open' });
    this.picture.alt = '';
    this.picture.className = 'gone';
    this.picture.addEventListener('error', () => this.picture.classList.add('gone'));
    this.words.setAttribute('role', 'status');
    this.wheel.hidden = true;
    this.playButton.type = 'button';
    this.playButton.textContent = faceWords.play;
    this.playButton.hidden = true;
    this.playButton.addEventListener('click', () => this.play());
    this.soundButton.type = 'button';
    this.soundButton.className = 'sound';
    this.soundButton.hidden = true;
    this.soundButton.addEventListener('click', () => void this.press().catch(() => this.update()));
    root.append(this.picture, this.wheel, this.words, this.playButton, this.soundButton);
    this.addEventListener('keydown', (event) => {
      const by = turnOfKey(event.key);
      if (!by || !this.show) return;
      event.preventDefault();
      this.turn(by);
    });
  }

  private make<Name extends keyof HTMLElementTagNameMap>(name: Name): HTMLElementTagNameMap[Name] {
    return document.createElement(name);
  }

  /** A token, for a server of another origin that asks for one. Write only; not an attribute, which pages show. */
  set token(value: string | null) {
    if (value === this.secret) return;
    this.secret = value;
    if (this.show?.face) this.show.setToken(value);
    else this.reload();
  }

  // ---- state ------------------------------------------------------------------------------------------------

  get state(): FaceState {
    return this.failed ? 'error' : (this.show?.state ?? 'idle');
  }

  /** What keeps the face from moving, as a sentence; empty: nothing. */
  get message(): string {
    const { state } = this;
    if (state === 'error' || state === 'ended' || state === 'stalled') return this.trouble()?.message ?? '';
    return '';
  }

  get paused(): boolean {
    return this.paused_ ?? lessMotion();
  }

  get connection(): Connection {
    const { show } = this;
    if (!show?.face) return 'none';
    if (show.link.state !== 'open') return 'lost';
    const { roundTrip } = show.link.client.streamClock;
    const delay = show.player?.delay ?? NaN;
    if (roundTrip > 700 || delay > 900) return 'poor';
    return roundTrip > 300 || delay > 450 ? 'fair' : 'good';
  }

  /** Measurements for display: a snapshot. */
  get stats(): { framesPerSecond: number; vertices: number; lod: number; delay: number; roundTrip: number } {
    const { show } = this;
    return {
      framesPerSecond: show?.framesPerSecond ?? 0,
      vertices: show?.face?.rig.mesh.vertices ?? 0,
      lod: show?.face?.rig.lod ?? 0,
      delay: show?.player?.delay ?? NaN,
      roundTrip: show?.link.client.streamClock.roundTrip ?? NaN,
    };
  }

  get isHeard(): boolean {
    return this.show?.isHeard ?? false;
  }

  /** Whether the browser's own voice says the text of the stream. */
  get isSpeaking(): boolean {
    return this.show?.isSpeaking ?? false;
  }

  // ---- methods ----------------------------------------------------------------------------------------------

  play(): void {
    this.paused_ = false;
    this.show?.setPaused(false);
    this.update();
  }

  pause(): void {
    this.paused_ = true;
    this.show?.setPaused(true);
    this.update();
  }

  /** To call by a tap or a key. Rejects where the browser does not allow sound. */
  async setSound(on: boolean): Promise<void> {
    await this.show?.setSound(on);
  }

  /** To call by a tap or a key. */
  async setVoice(on: boolean): Promise<void> {
    await this.show?.setVoice(on);
  }

  private async press(): Promise<void> {
    if (this.show?.hasVoice) await this.setVoice(!this.isSpeaking);
    else await this.setSound(!this.isHeard);
  }

  /** Turns the camera back to the front. */
  lookFront(): void {
    this.turn((camera) => camera.reset());
  }

  private turn(by: (camera: OrbitCamera) => void): void {
    if (!this.show) return;
    by(this.show.camera);
    this.show.invalidate();
  }

  /** Loads everything again, also after a trouble that does not pass by itself. */
  reload(): void {
    this.stop();
    if (this.inView) this.start();
    this.update();
  }

  // ---- life -------------------------------------------------------------------------------------------------

  connectedCallback(): void {
    const { defaultView } = this.ownerDocument;
    if (!defaultView || this.page === this.ownerDocument) return; // no window shows it, or it was moved within its page
    this.leave();
    this.page = this.ownerDocument;
    this.takeEarly();
    this.dress();
    this.name();
    this.setPoster();
    this.seen = new defaultView.IntersectionObserver((entries) => this.look(entries.at(-1)!.isIntersecting), { rootMargin: ahead });
    this.seen.observe(this);
  }

  /** What is moved within its page comes back at once: lists of frameworks do that when they are sorted. */
  disconnectedCallback(): void {
    queueMicrotask(() => {
      if (!this.isConnected || this.ownerDocument !== this.page) this.leave();
    });
  }

  private leave(): void {
    this.page = null;
    this.seen?.disconnect();
    this.seen = null;
    this.inView = false;
    this.stop();
  }

  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    if (before === now || !this.isConnected) return;
    if (name === 'poster') this.setPoster();
    else if (name === 'alt') this.name();
    else if (name === 'fit') this.show?.setFit(this.fit);
    else if (name === 'sound') this.show?.askSound(this.sound);
    else if (name === 'voice') this.show?.offerVoice(this.voice);
    else if (name === 'captions') void this.setCaptions();
    else this.reload();
  }

  private look(inView: boolean): void {
    this.inView = inView;
    if (inView && !this.show && !this.failed) this.start();
    this.show?.setVisible(inView);
  }

  private start(): void {
    if (this.stream === '') return;
    const stage = this.make('div');
    this.stage = stage;
    stage.className = 'stage';
    stage.setAttribute('role', 'img');
    this.name();
    turnByFingers(stage, () => this.getAttribute('orbit') !== 'none', (by) => this.turn(by));
    stage.addEventListener('dblclick', () => this.lookFront());
    this.shadowRoot!.insertBefore(stage, this.picture);
    try {
      expectIds(this.stream, this.model);
      const source: Source = { base: serverOf(this.src, document.baseURI), stream: this.stream, model: this.model, token: this.secret };
      const show = new FaceShow(stage, {
        source,
        fit: this.fit,
        quality: this.quality,
        fades: !lessMotion(),
        paused: this.paused,
        sound: this.sound,
        voice: this.voice,
      });
      this.show = show;
      show.on('state', (state) => {
        this.update();
        if (state === 'stalled' || state === 'ended') this.tell(state);
      });
      show.on('trouble', (cause) => {
        this.update();
        if (cause && show.face === null) this.tell('error', { code: cause.code, message: cause.message });
      });
      show.on('ready', () => {
        this.picture.classList.add('gone');
        this.update();
        this.tell('ready');
      });
      show.on('sound', () => this.update());
      show.on('playing', () => this.tell('playing'));
      show.on('cue', (cue) => this.caption(cue));
      if (this.captions) void this.setCaptions();
      show.on('level', (level) => this.tell('levelchange', level));
    } catch (error) {
      if (!(error instanceof FaceTrouble)) throw error;
      this.failed = error;
      this.tell('error', { code: error.code, message: error.message });
    }
    this.update();
  }

  private async setCaptions(): Promise<void> {
    const { show, captions } = this;
    if (captions && !this.captionsBox) {
      const { CaptionsBox, captionsStyle } = await import('../captions/index.ts');
      if (!this.captionsBox) {
        this.styles.push(captionsStyle);
        this.dress();
        this.captionsBox = new CaptionsBox();
        this.words.before(this.captionsBox.element);
      }
    }
    await show?.setCaptions(this.captions, () => this.captionsBox?.room ?? 0);
    this.updateSound();
  }

  private caption(cue: Cue | null): void {
    this.captionsBox?.show(cue);
    this.tell('cuechange', { text: cue?.text ?? '', language: cue?.language ?? '' });
  }

  private stop(): void {
    this.show?.close();
    this.show = null;
    this.failed = null;
    this.stage?.remove();
    this.stage = null;
    this.name();
    this.setPoster();
  }

  private tell(name: string, detail?: object): void {
    this.dispatchEvent(new CustomEvent(name, { detail: detail ?? null }));
  }

  private trouble(): FaceTrouble | null {
    if (this.failed) return this.failed;
    const { show } = this;
    if (!show) return null;
    if (show.trouble) return show.trouble;
    if (show.state === 'ended') return trouble('ended');
    return show.state === 'stalled' ? trouble('lost') : null;
  }

  /** Shows what the state means. */
  private update(): void {
    const { state } = this;
    this.wheel.hidden = state !== 'loading';
    const alone = state === 'error';
    if (this.words.textContent !== this.message) this.words.textContent = this.message;
    this.words.className = alone ? 'alone' : '';
    this.playButton.hidden = !(this.paused && (state === 'resting' || state === 'playing'));
    this.updateSound();
    this.stage?.classList.toggle('shown', !alone && !!this.show?.face);
    this.tell('statechange', { state, message: this.message });
  }

  private updateSound(): void {
    const { soundButton, show } = this;
    this.captionsBox?.setHeard(this.isHeard || this.isSpeaking);
    if (show?.hasVoice && show.face && this.state !== 'error') {
      soundButton.hidden = soundButton.disabled = false;
      soundButton.textContent = this.isSpeaking ? faceWords.voiceOff : faceWords.voiceOn;
      return;
    }
    soundButton.hidden = !this.sound || !(show?.hasSound ?? false) || this.state === 'error';
    const canHear = typeof AudioDecoder === 'function';
    soundButton.disabled = !canHear;
    soundButton.textContent = !canHear ? faceWords.noSound : this.isHeard ? faceWords.soundOff : faceWords.soundOn;
  }

  // ---- presentation -----------------------------------------------------------------------------------------

  private dress(): void {
    const { page } = this;
    if (page) this.shadowRoot!.adoptedStyleSheets = this.styles.map((text) => sheetOf(page, text));
  }

  /** The accessible name belongs to the picture; messages and the button beside it are read for themselves. */
  private name(): void {
    const label = this.getAttribute('alt') ?? faceWords.face(this.stream);
    this.stage?.setAttribute('aria-label', label);
    this.picture.alt = this.stage ? '' : label;
  }

  private setPoster(): void {
    this.picture.classList.toggle('gone', this.poster === '');
    if (this.poster !== '') this.picture.src = this.poster;
  }
}

function lessMotion(): boolean {
  return typeof matchMedia === 'function' && matchMedia('(prefers-reduced-motion: reduce)').matches;
}

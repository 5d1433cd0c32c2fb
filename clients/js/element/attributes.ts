import type { Fit } from '../view/framing.ts';
import type { QualityName } from './detail.ts';

const fits: readonly string[] = ['head', 'face', 'model'] satisfies Fit[];
const qualities: readonly string[] = ['auto', 'low', 'medium', 'high'] satisfies QualityName[];

/** What the markup of a page can say: for the types of frameworks (README.md). Undefined: not there. */
export interface FaceAttributes {
  src?: string | undefined;
  stream?: string | undefined;
  model?: string | null | undefined;
  fit?: Fit | undefined;
  quality?: QualityName | undefined;
  theme?: 'auto' | 'light' | 'dark' | undefined;
  poster?: string | undefined;
  alt?: string | undefined;
  orbit?: 'free' | 'none' | undefined;
  /** The empty text: as an attribute without a value. */
  sound?: boolean | '' | undefined;
  voice?: boolean | '' | undefined;
  captions?: boolean | '' | undefined;
}

/** What a page can set as properties. */
const properties = ['src', 'stream', 'model', 'poster', 'alt', 'fit', 'quality', 'theme', 'sound', 'voice', 'captions', 'token'] as const;

// Node has no elements; a page that is rendered there can import this module all the same.
const Base = (globalThis as { HTMLElement?: typeof HTMLElement }).HTMLElement ?? (class {} as typeof HTMLElement);

/** The attributes of a face as properties. README.md says what each means. */
export class FaceAttributesElement extends Base {
  /** Frameworks set null or undefined for what is not there. */
  private put(name: string, value: string | null | undefined): void {
    if (value === null || value === undefined) this.removeAttribute(name);
    else this.setAttribute(name, value);
  }

  /** React 18 writes `sound="false"` for `sound={false}`. */
  private isOn(name: string): boolean {
    return (this.getAttribute(name) ?? 'false') !== 'false';
  }

  /** What was set before the element was defined lies on the object itself and hides the properties of the class. */
  protected takeEarly(): void {
    for (const name of properties) {
      if (!Object.hasOwn(this, name)) continue;
      const value: unknown = Reflect.get(this, name);
      Reflect.deleteProperty(this, name);
      Reflect.set(this, name, value);
    }
  }

  get src(): string {
    return this.getAttribute('src') ?? '';
  }
  set src(value: string) {
    this.put('src', value);
  }
  get stream(): string {
    return this.getAttribute('stream') ?? '';
  }
  set stream(value: string) {
    this.put('stream', value);
  }
  get model(): string | null {
    return this.getAttribute('model');
  }
  set model(value: string | null) {
    this.put('model', value);
  }
  get poster(): string {
    return this.getAttribute('poster') ?? '';
  }
  set poster(value: string) {
    this.put('poster', value);
  }
  /** Empty: the attribute is missing, and the name is that of the stream. */
  get alt(): string {
    return this.getAttribute('alt') ?? '';
  }
  set alt(value: string) {
    this.put('alt', value);
  }
  get fit(): Fit {
    const value = this.getAttribute('fit') ?? '';
    return fits.includes(value) ? (value as Fit) : 'head';
  }
  set fit(value: Fit) {
    this.put('fit', value);
  }
  get quality(): QualityName {
    const value = this.getAttribute('quality') ?? '';
    return qualities.includes(value) ? (value as QualityName) : 'auto';
  }
  set quality(value: QualityName) {
    this.put('quality', value);
  }
  get theme(): string {
    return this.getAttribute('theme') ?? 'auto';
  }
  set theme(value: string) {
    this.put('theme', value);
  }

  /** Whether the stream's sound is asked for. A button, or `setSound`, lets it be heard: browsers demand a tap. */
  get sound(): boolean {
    return this.isOn('sound');
  }
  set sound(value: boolean) {
    this.toggleAttribute('sound', value);
  }

  /**
   * Whether the browser's own voice may say the text of the stream, in place of its sound: an eightieth of the bytes of face and sound. A button, or
   * `setVoice`, lets it speak. Where the browser has no voice it is as without this attribute.
   */
  get voice(): boolean {
    return this.isOn('voice');
  }
  set voice(value: boolean) {
    this.toggleAttribute('voice', value);
  }

  /** Whether what is said is shown as words, where the server knows them. */
  get captions(): boolean {
    return this.isOn('captions');
  }
  set captions(value: boolean) {
    this.toggleAttribute('captions', value);
  }
}

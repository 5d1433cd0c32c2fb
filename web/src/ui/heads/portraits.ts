import type { StillFace } from '../../face/package.ts';
import type { Model } from '../../net/types.ts';
import type { Studio } from '../shared/studio.ts';
import type { SceneView } from '../stage/scene.ts';
import type { Shelf } from './shelf.ts';

/** Pixels of a side of a thumbnail. */
export const thumbnailSize = 112;
/** Bytes of one small model, and of all that one page asks for: a list may have a thousand heads, and a phone pays for them. */
export const mostOfOne = 4 << 20;
export const mostOfAll = 24 << 20;
/** ms after the stage has its head, or after the last portrait: what one waits for comes first. */
const pause = 1500;

export interface PortraitSources {
  preview: (id: string, most: number) => Promise<{ bytes: Uint8Array | null; read: number }>;
  /** `most`: bytes of its images. */
  face: (id: string, level: number, most: number) => Promise<{ still: StillFace | null; imageBytes: number }>;
}

const parts = ['mesh.drc', 'weights', 'rig.json'];
const sum = (numbers: readonly number[]): number => numbers.reduce((all, one) => all + one, 0);

/** The smallest model of a head: a level of its face, or (null) the still model; with its bytes but for those of its images. */
export function smallestOf(model: Model): { level: number | null; bytes: number } | null {
  const { package: face, state, source } = model;
  // What is drawn of a file is rarely smaller than the file.
  if (!face) return state === 'ready' ? { level: null, bytes: source.bytes } : null;
  const levels = face.levels.length > 0 ? face.levels : [{ lod: 0, artefacts: face.artefacts }];
  const sizes = levels.map(({ lod, artefacts }) => ({ level: lod, bytes: sum(parts.map((name) => artefacts[name]?.bytes ?? Infinity)) }));
  return sizes.reduce((least, one) => (one.bytes < least.bytes ? one : least));
}

/** Whether one has asked the browser to load less. */
const savesData = (): boolean => (navigator as { connection?: { saveData?: boolean } }).connection?.saveData === true;

/** As soon as nothing else is to be done. */
const whenIdle = (act: () => void): void => {
  if ('requestIdleCallback' in window) requestIdleCallback(act);
  else act();
};

/**
 * Draws pictures of heads that were never opened in this browser, as far as their items are seen, one at a time in the background: each
 * from its smallest model, and none from one that is large.
 */
export class Portraits {
  private readonly tried = new Set<string>();
  private spent = 0;
  private timer = 0;
  private isBusy = false;
  private due: (() => void) | null = null;

  constructor(
    private readonly studio: Studio,
    private readonly scene: SceneView,
    private readonly shelf: Shelf,
    private readonly sources: PortraitSources,
    private readonly show: (id: string, picture: string) => void,
  ) {}

  /** Once the pictures are known that are kept already. */
  begin(): void {
    this.scene.stage.onFrame(() => {
      const { due } = this;
      this.due = null;
      due?.();
      return false;
    });
    const wake = (): void => this.wake();
    for (const signal of [this.scene.state, this.studio.models, this.studio.tab]) signal.watch(wake);
    document.addEventListener('visibilitychange', wake);
    document.addEventListener('scroll', wake, { capture: true, passive: true }); // of the list, or on a narrow page what it is in
    wake();
  }

  private wake(): void {
    if (this.isBusy) return;
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => whenIdle(() => void this.step()), pause);
  }

  private async step(): Promise<void> {
    if (this.isBusy || document.hidden || savesData() || this.scene.state.value.kind === 'loading') return;
    const model = this.shelf.seen().find((one) => this.isWanted(one));
    const small = model && smallestOf(model);
    if (!model || !small) return;
    this.isBusy = true;
    this.tried.add(keyOf(model));
    try {
      const still = await this.load(model.id, small);
      if (still) await this.draw(model, still);
    } catch {
      // Without an answer, or with one that cannot be drawn, the item keeps its icon.
    }
    this.isBusy = false;
    this.wake();
  }

  /** Bytes that the next portrait may take. */
  private get left(): number {
    return Math.min(mostOfOne, mostOfAll - this.spent);
  }

  private async load(id: string, { level, bytes: ofLevel }: { level: number | null; bytes: number }): Promise<StillFace | Uint8Array | null> {
    if (level === null) {
      const { bytes, read } = await this.sources.preview(id, this.left);
      this.spent += read;
      return bytes;
    }
    const { still, imageBytes } = await this.sources.face(id, level, this.left - ofLevel);
    this.spent += ofLevel + imageBytes;
    return still;
  }

  private isWanted(model: Model): boolean {
    if (this.shelf.thumbnails.has(model.id) || this.tried.has(keyOf(model)) || model.id === this.studio.selected.value?.id) return false;
    const small = smallestOf(model);
    return small !== null && small.bytes <= this.left;
  }

  private async draw(model: Model, still: StillFace | Uint8Array): Promise<void> {
    const take = await this.scene.portraitOf(model, still, thumbnailSize);
    await new Promise<void>((drawn) => {
      this.due = () => {
        const picture = take();
        // It may have been opened meanwhile: the picture from the stage knows the points.
        if (!this.shelf.thumbnails.has(model.id)) this.show(model.id, picture);
        drawn();
      };
    });
  }
}

/** A head is tried again when it has got a face. */
const keyOf = (model: Model): string => `${model.id}:${model.package?.parametrization ?? ''}`;

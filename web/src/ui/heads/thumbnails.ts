import type { SceneView } from '../stage/scene.ts';
import { Portraits, thumbnailSize, type PortraitSources } from './portraits.ts';
import type { Shelf } from './shelf.ts';
import type { Studio } from '../shared/studio.ts';
import type { ThumbnailStore } from './thumbnail_store.ts';

/** ms for which a head has been shown: its first pictures are drawn by then, for whose programs an image at once would hold up the page. */
const shownFor = 700;

/**
 * Gives the shelf a thumbnail of each head, taken when the head is first shown on the stage, and again when its points tell where the
 * face is. Those of heads that this browser has not opened are drawn from small models (portraits.ts).
 */
export function takeThumbnails(studio: Studio, scene: SceneView, shelf: Shelf, store: ThumbnailStore, sources: PortraitSources): void {
  const taken = new Set<string>();
  let timer = 0;
  let isDue = false;
  const show = (id: string, picture: string): void => {
    shelf.thumbnails.set(id, picture);
    void store.keep(id, picture);
    shelf.draw();
  };
  const portraits = new Portraits(studio, scene, shelf, sources, show);
  const present = (): string => `${studio.selected.value?.id}:${scene.rig !== null}`;
  const untilListed = studio.shelf.watch(({ kind }) => {
    if (kind !== 'ready') return;
    queueMicrotask(() => untilListed());
    void store.read(new Set(studio.models.value.map(({ id }) => id))).then((kept) => {
      for (const [id, picture] of kept) if (!shelf.thumbnails.has(id)) shelf.thumbnails.set(id, picture);
      if (kept.size > 0) shelf.draw();
      portraits.begin();
    });
  });
  scene.state.watch(({ kind }) => {
    clearTimeout(timer);
    isDue = false;
    if (kind === 'ready' && !taken.has(present())) timer = window.setTimeout(() => (isDue = true), shownFor);
  });
  scene.stage.onFrame(() => {
    const model = isDue ? studio.selected.value : null;
    isDue = false;
    if (!model) return false;
    taken.add(present());
    show(model.id, scene.thumbnail(thumbnailSize));
    return false;
  });
}

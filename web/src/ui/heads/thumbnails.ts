import type { SceneView } from '../stage/scene.ts';
import type { Shelf } from './shelf.ts';
import type { Studio } from '../shared/studio.ts';

const size = 112;
/** ms for which a head has been shown: its first pictures are drawn by then, for whose programs an image at once would hold up the page. */
const shownFor = 700;

/** Gives the shelf a thumbnail of each head, taken when the head is first shown on the stage, and again when its points tell where the face is. */
export function takeThumbnails(studio: Studio, scene: SceneView, shelf: Shelf): void {
  const taken = new Set<string>();
  let timer = 0;
  let isDue = false;
  const present = (): string => `${studio.selected.value?.id}:${scene.rig !== null}`;
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
    shelf.thumbnails.set(model.id, scene.thumbnail(size));
    shelf.draw();
    return false;
  });
}

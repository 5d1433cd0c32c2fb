import type { SceneView } from '../stage/scene.ts';
import type { Shelf } from './shelf.ts';
import type { Studio } from '../shared/studio.ts';

const size = 112;

/** Gives the shelf a thumbnail of each head, taken when the head is first shown on the stage. */
export function takeThumbnails(studio: Studio, scene: SceneView, shelf: Shelf): void {
  scene.state.watch((state) => {
    const model = studio.selected.value;
    if (state.kind !== 'ready' || !model || shelf.thumbnails.has(model.id)) return;
    requestAnimationFrame(() => {
      shelf.thumbnails.set(model.id, scene.thumbnail(size));
      shelf.draw();
    });
  });
}

import type { SceneView } from '../stage/scene.ts';
import type { Shelf } from './shelf.ts';
import type { Studio } from '../shared/studio.ts';

const size = 112;

/** Gives the shelf a thumbnail of each head, taken when the head is first shown on the stage, and again when its points tell where the face is. */
export function takeThumbnails(studio: Studio, scene: SceneView, shelf: Shelf): void {
  const taken = new Set<string>();
  scene.state.watch((state) => {
    const model = studio.selected.value;
    const key = `${model?.id}:${scene.rig !== null}`;
    if (state.kind !== 'ready' || !model || taken.has(key)) return;
    taken.add(key);
    requestAnimationFrame(() => {
      shelf.thumbnails.set(model.id, scene.thumbnail(size));
      shelf.draw();
    });
  });
}

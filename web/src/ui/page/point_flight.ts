import type { ViewName } from '../../view/stage.ts';
import { bestView } from '../points/guide_data.ts';
import type { PointsModel } from '../points/points_model.ts';
import type { Studio } from '../shared/studio.ts';
import type { SceneView } from '../stage/scene.ts';

/** Half the height of the picture of a chosen point, in radii of the head. */
const around = 0.5;

/** The side of the head from which the place of a point is seen: ears and corners of the jaw are on one, odd numbers on the left. */
export function sideOf(id: string): ViewName {
  const [group, number] = id.split('.').map(Number) as [number, number];
  if (group === 10 || (group === 2 && number >= 13)) return number % 2 === 1 ? 'left' : 'right';
  return bestView(id) === 'side' ? 'left' : 'front';
}

/**
 * Brings the camera in front of each point that is chosen anywhere but on the head; for a point that is not placed yet, to the
 * side of the face where it lies.
 */
export function flyToPoints(studio: Studio, points: PointsModel, scene: SceneView): void {
  let asked: string | null = null;
  const fly = (): void => {
    if (asked === null || studio.tab.value !== 'points' || scene.state.value.kind !== 'ready' || !points.opened) return;
    const place = points.draft.points.get(asked);
    const side = sideOf(asked);
    asked = null;
    if (place) scene.flyTo([place.position], [], scene.stage.headRadius * around);
    else scene.stage.lookFrom(side);
  };
  points.chosen.watch((id) => {
    asked = points.pickedOnHead ? null : id;
    fly();
  });
  // More than one at once are of a file or proposals: whoever places them one by one has the camera in front of each.
  let before = 0;
  points.changed.watch(() => {
    const { points: placed } = points.draft;
    if (placed.size > before + 1 && scene.state.value.kind === 'ready') scene.frameByPoints([...placed.values()].map(({ position }) => position));
    before = placed.size;
  });
  // A link names a point before the head and its points are there.
  scene.state.watch(fly);
  points.changed.watch(fly);
  studio.tab.watch(fly);
}

import type { Finding, Model, Vector } from '../../net/types.ts';
import type { Marker, MarkerTone } from '../../view/markers.ts';
import type { FitModel } from './fit_model.ts';
import type { PointsModel } from '../points/points_model.ts';
import type { SceneView } from '../stage/scene.ts';
import type { Studio } from '../shared/studio.ts';

type Place = readonly [number, number, number];

/** Keeps the stage's highlight in step with the selection: a finding, a part, or the feature points. */
export function pointOutFindings(studio: Studio, fit: FitModel, points: PointsModel, scene: SceneView): void {
  const markers = (): void => scene.setMarkers(makeMarkers(studio, fit, points));
  const target = (): void => {
    const finding = studio.tab.value === 'fit' ? fit.chosen.value : null;
    const part = studio.tab.value === 'fit' ? (fit.hoveredPart.value ?? fit.part.value) : null;
    if (part !== null) scene.pointOut({ tone: 'part', vertices: [], parts: [part] });
    else if (finding)
      scene.pointOut({
        tone: finding.severity,
        vertices: finding.place.vertices.sample,
        parts: finding.place.part === null || isWhole(studio, finding.place.part) ? [] : [finding.place.part],
      });
    else scene.pointOut(null);
    markers();
  };
  points.changed.watch(markers);
  points.chosen.watch(markers);
  studio.tab.watch(target);
  fit.hoveredPart.watch(target);
  fit.part.watch((part) => {
    target();
    const model = studio.selected.value;
    const box = model?.parts?.find((one) => one.index === part)?.bounds;
    if (box) scene.flyTo([box.min, box.max], []);
  });
  fit.chosen.watch((finding) => {
    target();
    const model = studio.selected.value;
    if (finding && model) scene.flyTo(placesOf(finding, model, points, scene), finding.place.vertices.sample);
  });
  // A head that has just been loaded gets the highlight of the current selection.
  scene.state.watch(target);
}

/** Whether the part is the whole head: a tint over the largest part, the skin, would carry no information. */
function isWhole(studio: Studio, part: number): boolean {
  const parts = studio.selected.value?.parts ?? [];
  const most = Math.max(...parts.map((one) => one.vertices));
  return parts.find((one) => one.index === part)?.vertices === most;
}

/** The places of a finding; the whole part only when the finding names no more precise place. */
function placesOf({ place }: Finding, model: Model, points: PointsModel, scene: SceneView): Place[] {
  const places: Place[] = place.vertices.sample.flatMap((vertex) => {
    const at = scene.preview?.positionOf(vertex);
    return at ? [at.toArray() as Vector] : [];
  });
  for (const id of place.points) {
    const point = points.draft.points.get(id);
    if (point) places.push(point.position);
  }
  if (place.position) places.push(place.position);
  if (places.length > 0) return places;
  const box = model.parts?.find((one) => one.index === place.part)?.bounds;
  return box ? [box.min, box.max] : [];
}

/** The markers of the points: on the Fit tab only those of the chosen finding, else all. */
function makeMarkers(studio: Studio, fit: FitModel, points: PointsModel): Marker[] {
  const named = studio.tab.value === 'fit' ? new Set(fit.chosen.value?.place.points) : null;
  const markers: Marker[] = [];
  for (const [id, point] of points.draft.points) {
    if (named && !named.has(id)) continue;
    markers.push({ id, position: point.position, tone: named ? 'selected' : toneOf(id, points) });
  }
  return markers;
}

function toneOf(id: string, points: PointsModel): MarkerTone {
  if (points.chosen.value === id) return 'selected';
  if (points.problems.has(id)) return 'wrong';
  if (points.draft.points.get(id)?.proposal) return 'proposed';
  return points.draft.isChanged(id) ? 'changed' : 'placed';
}

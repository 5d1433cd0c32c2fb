import { faps, featurePoints } from '@protocol/generated/mpeg4.ts';
import { featurePointIndex } from '@protocol/rig_document.ts';
import { pointById } from '../../face/feature_points.ts';
import {
  colourRegions,
  influencersOf,
  movingPoints,
  paintHeat,
  paintRegions,
  paintStrongest,
  paintUncovered,
  skinVertices,
  strongestPoints,
  type Coverage,
} from '../../face/influence_map.ts';
import { heatStops, regionColours, type Rgb } from '../../face/influence_palette.ts';
import { InfluenceView, type Disc } from '../../view/influence_view.ts';
import { capital } from '../shared/names.ts';
import { Signal } from '../shared/signal.ts';
import type { SceneView } from '../stage/scene.ts';
import { t } from '../../words/words.ts';

/**
 * - `heat`: the weights of the chosen points, added up.
 * - `regions`: each chosen point in its colour.
 * - `strongest`: each vertex in the colour of its strongest point.
 * - `uncovered`: what follows no point.
 */
export type InfluenceMode = 'heat' | 'regions' | 'strongest' | 'uncovered';

/** What a vertex follows, for people. */
export interface Reading {
  vertex: number;
  /** The strongest first. */
  points: { id: string; name: string; weight: number }[];
  /** 0..1 */
  total: number;
}

/** The point that is chosen first where there is one: in the middle of what people look at. */
const firstPoint = '8.3';

/** The influence of the feature points on the shown face: what is chosen, and its picture on the stage. */
export class InfluenceModel {
  readonly on = new Signal(false);
  readonly mode = new Signal<InfluenceMode>('heat');
  /** The chosen points by id, in the order of choice. */
  readonly chosen = new Signal<readonly string[]>([]);
  /** The FAP whose points are shown, as its slider was used; null: points chosen by hand. */
  readonly fap = new Signal<number | null>(null);
  /** Of the shown face; null while there is none. */
  readonly coverage = new Signal<Coverage | null>(null);
  /** Ids of the points that move at least one vertex of the shown face. */
  moving: ReadonlySet<string> = new Set();
  private strongest: Int16Array = new Int16Array();
  private skin: Uint8Array = new Uint8Array();
  private regionOf: Uint8Array = new Uint8Array();

  /** `leader`: the model of the first view, whose colours of regions and choice this one takes over; null: this is the first. */
  constructor(
    private readonly scene: SceneView,
    private readonly leader: InfluenceModel | null = null,
  ) {
    scene.performer.watch(() => this.takeFace());
    this.on.watch((on) => {
      if (on) this.prepare();
      scene.showInfluence(on);
    });
    for (const signal of [this.mode, this.chosen] as Signal<unknown>[]) signal.watch(() => this.draw());
  }

  /** Shows what the leader shows. Returns the function that ends it. */
  followLeader(): () => void {
    const { leader } = this;
    if (!leader) return () => {};
    const ends = [
      leader.mode.watch((mode) => this.mode.set(mode)),
      leader.chosen.watch((chosen) => this.chosen.set(chosen)),
      leader.on.watch((on) => this.on.set(on)),
    ];
    return () => ends.forEach((end) => end());
  }

  /** Whether weights are on the stage. */
  get shown(): boolean {
    return this.on.value && this.scene.faceShown.value;
  }

  /** Shows one point, or with `add` also this point; a point that is shown already goes with `add`. */
  choose(id: string, add: boolean): void {
    const before = this.chosen.value;
    this.fap.set(null);
    if (!add) this.chosen.set([id]);
    else this.chosen.set(before.includes(id) ? before.filter((other) => other !== id) : [...before, id]);
    this.showChosen();
  }

  clear(): void {
    this.fap.set(null);
    this.chosen.set([]);
  }

  /** Lights the points of a FAP that is moved, also those that follow them. `mirror`: the FAP that moves with it, or 0. */
  useFap(number: number, mirror: number): void {
    if (!this.on.value) return;
    const ids = new Set([number, mirror].flatMap((fap) => faps[fap - 1]?.featurePoints ?? []));
    for (const { point, leader } of this.scene.rig?.companions ?? []) if (ids.has(leader)) ids.add(point);
    this.fap.set(number);
    const next = [...ids];
    if (next.join() !== this.chosen.value.join()) this.chosen.set(next);
    this.showChosen();
  }

  /** The colour of a point in the map of regions; null: the point has none there. */
  colourOf(id: string): Rgb | null {
    const mode = this.mode.value;
    if (mode === 'strongest') {
      const colour = this.regionOf[featurePointIndex(id)!];
      return this.moving.has(id) && colour !== undefined ? (regionColours[colour] ?? null) : null;
    }
    const at = this.chosen.value.indexOf(id);
    return mode === 'regions' && at >= 0 ? regionColours[at % regionColours.length]! : null;
  }

  read(vertex: number): Reading | null {
    const mesh = this.scene.face?.mesh;
    if (!mesh || vertex < 0 || vertex >= mesh.vertexCount) return null;
    const found = influencersOf(mesh, vertex);
    return {
      vertex,
      points: found.map(({ point, weight }) => {
        const { id } = featurePoints[point]!;
        return { id, name: pointName(id), weight };
      }),
      total: found.reduce((sum, { weight }) => sum + weight, 0),
    };
  }

  private showChosen(): void {
    if (this.mode.value === 'strongest' || this.mode.value === 'uncovered') this.mode.set('heat');
  }

  private takeFace(): void {
    const mesh = this.scene.face?.mesh;
    this.moving = new Set();
    if (mesh) movingPoints(mesh).forEach((moves, i) => moves && (this.moving as Set<string>).add(featurePoints[i]!.id));
    this.strongest = new Int16Array();
    this.skin = mesh ? skinVertices(mesh, this.scene.rig?.materials ?? []) : new Uint8Array();
    this.coverage.set(mesh ? paintUncovered(mesh, this.skin, new Uint8Array(mesh.vertexCount * 4)) : null);
    if (!this.on.value) return;
    this.prepare();
    this.scene.showInfluence(true);
  }

  /** Makes the picture of a face when it is first asked for. */
  private prepare(): void {
    const { scene } = this;
    const { face, rig } = scene;
    if (!face || !rig || scene.influence) return;
    scene.influence = new InfluenceView(face, rig.feature_points, heatStops);
    this.strongest = strongestPoints(face.mesh);
    this.regionOf = colourRegions(this.strongest, face.mesh.indices);
    this.leader?.regionOf.forEach((colour, point) => {
      if (colour < regionColours.length) this.regionOf[point] = colour;
    });
    if (this.chosen.value.length === 0) {
      const first = this.moving.has(firstPoint) ? firstPoint : [...this.moving][0];
      if (first) this.chosen.set([first]);
    }
    this.draw();
  }

  private draw(): void {
    const { influence, face, rig } = this.scene;
    if (!influence || !face || !rig) return;
    const { mesh } = face;
    const mode = this.mode.value;
    const chosen = this.chosen.value.map((id) => featurePointIndex(id)!);
    if (mode === 'heat') paintHeat(mesh, new Set(chosen), influence.paint);
    else if (mode === 'regions')
      paintRegions(mesh, new Map(chosen.map((point, i) => [point, i % regionColours.length])), influence.paint);
    else if (mode === 'strongest') paintStrongest(this.strongest, this.regionOf, influence.paint);
    else paintUncovered(mesh, this.skin, influence.paint);
    influence.repaint(mode === 'heat');
    influence.showDiscs(rig.feature_points.map(({ id }) => this.disc(id)));
    this.scene.stage.invalidate();
  }

  private disc(id: string): Disc {
    const bySelection = this.mode.value === 'heat' || this.mode.value === 'regions';
    if (bySelection && this.chosen.value.includes(id)) return { color: this.colourOf(id) ?? [255, 90, 44], size: 15 };
    return this.moving.has(id) ? { color: [70, 66, 64], size: 6 } : null;
  }
}

export const pointName = (id: string): string => capital(pointById(id)?.name ?? id);

/** "62 %"; less than one per cent is said so. */
export const percent = (weight: number): string => (weight > 0 && weight < 0.01 ? '< 1 %' : `${Math.round(weight * 100)} %`);

/** "Vertex 812 follows 8.3 Left corner of outer lip by 62 % and 2.4 Left corner of inner lip by 38 %." */
export function readingWords({ vertex, points }: Reading): string {
  if (points.length === 0) return t('Vertex {vertex} follows no feature point.', { vertex });
  const parts = points.map(({ id, name, weight }) => t('{id} {name} by {weight}', { id, name, weight: percent(weight) }));
  const last = parts.pop()!;
  return t('Vertex {vertex} follows {last}.', { vertex, last: parts.length > 0 ? t('{list} and {last}', { list: parts.join(', '), last }) : last });
}

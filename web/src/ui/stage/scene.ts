import { Vector3 } from 'three';
import type { LoadedFace } from '../../face/loaded_face.ts';
import { Performer } from '../../face/performer.ts';
import type { Model } from '../../net/types.ts';
import { problemOf } from '../../net/problem.ts';
import type { Problem } from '../../net/types.ts';
import { makeMaterials } from '@client/three/face_materials.ts';
import { FaceView, type DeformPath } from '@client/three/face_view.ts';
import { ballAround, Highlight, type HighlightTarget } from '../../view/highlight.ts';
import type { UnitLines } from '../../view/unit_lines.ts';
import type { InfluenceView } from '../../view/influence_view.ts';
import { Markers, type Marker } from '../../view/markers.ts';
import { PreviewView } from '../../view/preview_view.ts';
import { chooseQuality, type Quality } from '../../view/quality.ts';
import { Stage } from '../../view/stage.ts';
import { Signal } from '../shared/signal.ts';
import { t } from '../../words/words.ts';

export type SceneState =
  { kind: 'empty' } | { kind: 'loading'; title: string } | { kind: 'ready' } | { kind: 'failed'; problem: Problem };

export interface SceneSources {
  preview: (model: Model, signal: AbortSignal) => Promise<Uint8Array>;
  /** `level` 0 is the full mesh. */
  face: (model: Model, level: number, signal: AbortSignal) => Promise<LoadedFace>;
}

/** The contents of the stage: the still preview with its markers, or the animated face. */
export class SceneView {
  readonly stage: Stage;
  private readonly quality: Quality;
  readonly markers: Markers;
  readonly highlight = new Highlight();
  readonly state = new Signal<SceneState>({ kind: 'empty' });
  /** The performer of the animated face; null while there is none. */
  readonly performer = new Signal<Performer | null>(null);
  readonly packageBytes = new Signal(0);
  /** The displayed level of detail of the face; 0 is the full mesh. */
  readonly level = new Signal(0);
  /** Whether the animated face is on the stage, not the still model. */
  readonly faceShown = new Signal(false);
  preview: PreviewView | null = null;
  face: FaceView | null = null;
  /** What the server told of the animated face. */
  rig: LoadedFace['rig'] | null = null;
  private painted: InfluenceView | null = null;
  private lines: UnitLines | null = null;
  private wanted: 'preview' | 'face' = 'face';
  private path: DeformPath = 'gpu';
  private wire = false;
  private lipFollows = false;
  private opening: AbortController | null = null;
  private model: Model | null = null;
  private shown = '';
  private previewKey = '';

  constructor(
    canvas: HTMLCanvasElement,
    private readonly sources: SceneSources,
  ) {
    this.quality = chooseQuality();
    this.stage = new Stage(canvas, this.quality);
    this.markers = new Markers();
    this.markers.object.visible = false;
    this.stage.scene.add(this.markers.object, this.highlight.object);
    this.stage.onFrame((delta) => this.step(delta));
  }

  /** Advances the performer by one displayed frame, seconds; returns whether its pose changed. */
  animate: (deltaSeconds: number) => boolean = () => false;

  /** Shows a model or the changes of the shown model. The old picture stays until the new one is loaded. */
  async open(model: Model | null): Promise<void> {
    if (packageOf(model) !== packageOf(this.model)) this.level.set(0);
    this.model = model;
    const axes = model?.frame?.axes;
    const key = model
      ? `${model.id}:${model.state}:${packageOf(model)}:${this.level.value}:${axes?.up ?? ''}${axes?.front ?? ''}`
      : '';
    if (key === this.shown) return;
    const sameModel = key.split(':')[0] === this.shown.split(':')[0];
    this.shown = key;
    this.opening?.abort();
    const opening = new AbortController();
    this.opening = opening;
    if (!model) {
      this.clear();
      this.state.set({ kind: 'empty' });
      return;
    }
    if (model.state === 'importing') {
      if (!sameModel) this.clear();
      this.state.set({ kind: 'loading', title: t('Reading the file') });
      return;
    }
    if (model.state === 'failed') {
      this.clear();
      this.state.set({
        kind: 'failed',
        problem: model.problem ?? { type: 'about:blank', title: t('The file could not be read'), status: 422 },
      });
      return;
    }
    this.state.set({ kind: 'loading', title: t('Opening the head') });
    try {
      const parts = {
        preview: this.openPreview(model, opening.signal),
        face: model.state === 'parametrized' ? this.openFace(model, opening.signal) : Promise.resolve(null),
      };
      const [preview, face] = await Promise.all([parts.preview, parts.face]);
      if (opening.signal.aborted) return;
      this.install(preview, face);
      this.state.set({ kind: 'ready' });
    } catch (error) {
      if (opening.signal.aborted) return;
      this.clear();
      this.shown = '';
      this.state.set({ kind: 'failed', problem: problemOf(error) });
    }
  }

  showLevel(level: number): void {
    this.level.set(level);
    void this.open(this.model);
  }

  /** Switches between the still model with its markers and the animated face (if there is one). */
  show(what: 'preview' | 'face'): void {
    this.wanted = what;
    const face = what === 'face' && this.face !== null;
    if (this.preview) this.preview.object.visible = !face;
    if (this.face) this.face.object.visible = face;
    this.markers.object.visible = what === 'preview' && this.preview !== null;
    this.highlight.object.visible = this.markers.object.visible;
    this.faceShown.set(face);
    this.stage.invalidate();
  }

  setMarkers(markers: Marker[]): void {
    this.markers.set(markers);
    this.stage.invalidate();
  }

  /** Highlights vertices and parts of the still model, replacing the previous highlight. */
  pointOut(target: HighlightTarget | null): void {
    this.highlight.show(this.preview, target);
    this.stage.invalidate();
  }

  /** Moves the camera to these places of the still model, with a radius of at least `least` (model units). */
  flyTo(places: readonly (readonly [number, number, number])[], vertices: readonly number[], least = 0): void {
    if (!this.preview || places.length === 0) return;
    const { center, radius } = ballAround(places.map((place) => new Vector3(...place)));
    this.stage.lookAt(center, Math.max(radius * 1.3, least), this.preview.normalAt(vertices));
  }

  set wireframe(on: boolean) {
    this.wire = on;
    if (this.preview) this.preview.wireframe = on;
    if (this.face) this.face.wireframe = on;
    if (this.painted) this.painted.wireframe = on;
    this.stage.invalidate();
  }

  get deformPath(): DeformPath {
    return this.path;
  }

  set deformPath(path: DeformPath) {
    this.path = path;
    this.face?.usePath(path);
    this.painted?.usePath(path);
    const performer = this.performer.value;
    if (performer && this.face) this.pose(this.face, performer);
    this.stage.invalidate();
  }

  private step(delta: number): boolean {
    const { face } = this;
    const performer = this.performer.value;
    if (!face || !performer || !face.object.visible) return false;
    if (!this.animate(delta)) return false;
    this.pose(face, performer);
    return true;
  }

  /** What paints the weights over the face; null: nothing. It belongs to the face, and ends with it. */
  get influence(): InfluenceView | null {
    return this.painted;
  }

  set influence(view: InfluenceView | null) {
    this.painted?.dispose();
    this.painted = view;
    if (!view) return;
    view.usePath(this.path);
    view.wireframe = this.wire;
  }

  /** The lines of the face's units; null: none. They belong to the face, and end with it. */
  set units(lines: UnitLines | null) {
    this.lines?.dispose();
    this.lines = lines;
    if (lines && this.face && this.performer.value) {
      lines.setPose(this.performer.value.pose);
      this.face.object.add(lines.object);
    }
    this.stage.invalidate();
  }

  showInfluence(on: boolean): void {
    if (!this.painted) return;
    this.painted.on = on;
    if (this.face && this.performer.value) this.pose(this.face, this.performer.value);
    this.stage.invalidate();
  }

  /** A small image of the head as it is, without its weights. */
  thumbnail(size: number): string {
    const { painted } = this;
    const on = painted?.on ?? false;
    if (painted) painted.on = false;
    const image = this.stage.thumbnail(size);
    if (painted) painted.on = on;
    return image;
  }

  private pose(face: FaceView, performer: Performer): void {
    // The feature points of the influence view are moved by the shader on both paths.
    if (this.path === 'gpu' || this.painted?.on) face.setPose(performer.pose);
    this.lines?.setPose(performer.pose);
    if (this.path === 'gpu') return;
    performer.kernel.deform(performer.poseNumber);
    face.setVertices(performer.kernel.positions, performer.pose);
  }

  /** Loads the preview; the shown one is kept unless the axes of the head have changed. */
  private async openPreview(model: Model, signal: AbortSignal): Promise<PreviewView> {
    const key = `${model.id}:${JSON.stringify(model.frame?.axes)}`;
    if (this.preview && this.previewKey === key) return this.preview;
    const preview = await PreviewView.load(await this.sources.preview(model, signal), this.quality.richSkin);
    if (!signal.aborted) this.previewKey = key;
    return preview;
  }

  private async openFace(model: Model, signal: AbortSignal): Promise<{ view: FaceView; loaded: LoadedFace }> {
    const loaded = await this.sources.face(model, this.level.value, signal);
    const materials = await makeMaterials(loaded.materials, this.quality.richSkin);
    return { view: new FaceView(loaded.mesh, materials), loaded };
  }

  private install(preview: PreviewView, face: { view: FaceView; loaded: LoadedFace } | null): void {
    const another = preview !== this.preview;
    if (another) {
      this.highlight.clear();
      this.preview?.dispose();
      this.preview = preview;
      this.stage.scene.add(preview.object);
    }
    this.performer.value?.dispose();
    this.influence = null;
    this.units = null;
    this.face?.dispose();
    this.face = face?.view ?? null;
    this.rig = face?.loaded.rig ?? null;
    this.packageBytes.set(face?.loaded.packageBytes ?? 0);
    if (face) {
      this.stage.scene.add(face.view.object);
      face.view.usePath(this.path);
      face.loaded.kernel.setJawTakesLip(this.lipFollows);
      const performer = new Performer(face.loaded.kernel);
      this.pose(face.view, performer);
      this.performer.set(performer);
    } else {
      this.performer.set(null);
    }
    this.wireframe = this.wire;
    if (another) this.stage.frameObject(preview.object, preview.head());
    this.show(this.wanted);
  }

  /** Whether FAP 3 alone takes the lower lip along, on this face and those to come. */
  set jawTakesLip(takes: boolean) {
    this.lipFollows = takes;
    this.performer.value?.kernel.setJawTakesLip(takes);
  }

  private clear(): void {
    this.highlight.clear();
    this.influence = null;
    this.units = null;
    this.preview?.dispose();
    this.face?.dispose();
    this.preview = null;
    this.face = null;
    this.rig = null;
    this.packageBytes.set(0);
    this.performer.value?.dispose();
    this.performer.set(null);
    this.show(this.wanted);
  }
}

const packageOf = (model: Model | null): string => model?.package?.parametrization ?? '';

import { Vector3 } from 'three';
import type { LoadedFace } from '../../face/loaded_face.ts';
import type { StillFace } from '../../face/package.ts';
import { pickVertex } from '../../face/ray_pick.ts';
import { Performer } from '../../face/performer.ts';
import type { Model } from '../../net/types.ts';
import { problemOf } from '../../net/problem.ts';
import type { Problem } from '../../net/types.ts';
import { makeMaterials } from '@client/three/face_materials.ts';
import { FaceView, type DeformPath } from '@client/three/face_view.ts';
import { ballAround, Highlight, type HighlightTarget } from '../../view/highlight.ts';
import { disposeMaterials } from '../../view/dispose_materials.ts';
import type { UnitLines } from '../../view/unit_lines.ts';
import type { InfluenceView } from '../../view/influence_view.ts';
import { framedHead, headOfPoints } from '../../view/head_box.ts';
import { Markers, type Marker } from '../../view/markers.ts';
import { PreviewView } from '../../view/preview_view.ts';
import { chooseQuality, type Quality } from '../../view/quality.ts';
import { Stage, type ViewName } from '../../view/stage.ts';
import { Signal } from '../shared/signal.ts';
import { t } from '../../words/words.ts';

/** The skin about a point whose direction tells from where the point is seen best, in radii of the head. */
const aroundPoint = 0.15;

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
  /** A second view that draws its face in the same way; null: none. Set by `joinTwin`. */
  twin: SceneView | null = null;
  private painted: InfluenceView | null = null;
  private lines: UnitLines | null = null;
  private wanted: 'preview' | 'face' = 'face';
  private path: DeformPath = 'gpu';
  private wire = false;
  private lipFollows = false;
  private hidden: ReadonlySet<number> = new Set();
  private opening: AbortController | null = null;
  private model: Model | null = null;
  private shown = '';
  private previewKey = '';
  /** The head and axes for which the camera was set up. */
  private framed = '';

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

  /** The media time of a stream that the face shows, ms; undefined: its own. */
  clock: (() => number) | undefined;

  /** Advances the performer by one displayed frame, seconds; returns whether its pose changed. */
  animate: (deltaSeconds: number) => boolean = () => false;

  /**
   * Shows a model or the changes of the shown model. The old picture stays until the new one is loaded. Without a `level` the
   * shown one stays, unless the package is another.
   */
  async open(model: Model | null, level?: number): Promise<void> {
    this.level.set(level ?? (packageOf(model) === packageOf(this.model) ? this.level.value : 0));
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
      const animated = model.state === 'parametrized';
      // A visitor who only looks at the face does not wait for the still model.
      const load = (): Promise<PreviewView> | null =>
        !animated || this.wanted === 'preview' ? this.openPreview(model, opening.signal) : null;
      const [early, face] = await Promise.all([load(), animated ? this.openFace(model, opening.signal) : null]);
      const preview = early ?? (await load()); // the tab may have changed meanwhile
      if (opening.signal.aborted) return;
      if (preview === null && this.previewKey !== previewKeyOf(model)) this.setPreview(null, '');
      this.install(model, preview, face);
      this.state.set({ kind: 'ready' });
    } catch (error) {
      if (opening.signal.aborted) return;
      this.clear();
      this.shown = '';
      this.state.set({ kind: 'failed', problem: problemOf(error) });
    }
  }

  showLevel(level: number): void {
    void this.open(this.model, level);
  }

  /** Switches between the still model with its markers and the animated face (if there is one). */
  show(what: 'preview' | 'face'): void {
    this.wanted = what;
    if (what === 'preview') void this.fetchPreview();
    const face = what === 'face' && this.face !== null;
    if (this.preview) this.preview.object.visible = !face;
    // Until the still model is there, the face stands in its place.
    if (this.face) this.face.object.visible = face || this.preview === null;
    this.markers.object.visible = what === 'preview' && this.preview !== null;
    this.highlight.object.visible = this.markers.object.visible;
    this.faceShown.set(face);
    this.stage.invalidate();
  }

  /** These parts of the still model are neither drawn nor picked. */
  hideParts(parts: ReadonlySet<number>): void {
    this.hidden = parts;
    this.preview?.hide(parts);
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
    const outward =
      places.length === 1 ? this.preview.outwardAt(center, this.stage.headRadius * aroundPoint) : this.preview.normalAt(vertices);
    this.stage.lookAt(center, Math.max(radius * 1.3, least), outward);
  }

  /** The place of the shown surface at `x`, `y` (normalized device coordinates), of a face as it is moved now; null: none is there. */
  surfaceAt(x: number, y: number): readonly [number, number, number] | null {
    const performer = this.performer.value;
    const { camera } = this.stage;
    if (!this.faceShown.value || !this.face || !performer) return this.preview?.pick(x, y, camera)?.position ?? null;
    const direction = new Vector3(x, y, 0.5).unproject(camera).sub(camera.position);
    performer.kernel.deform(performer.poseNumber);
    const { positions } = performer.kernel;
    const vertex = pickVertex(positions, this.face.mesh.indices, Float64Array.of(...camera.position.toArray(), ...direction.toArray()));
    return vertex < 0 ? null : [positions[vertex * 3]!, positions[vertex * 3 + 1]!, positions[vertex * 3 + 2]!];
  }

  set wireframe(on: boolean) {
    this.wire = on;
    if (this.preview) this.preview.wireframe = on;
    if (this.face) this.face.wireframe = on;
    if (this.painted) this.painted.wireframe = on;
    if (this.twin) this.twin.wireframe = on;
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
    if (this.twin) this.twin.deformPath = path;
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

  /** A small image of the whole head, without its weights and points. */
  thumbnail(size: number): string {
    const { painted, preview, hidden } = this;
    preview?.hide(new Set());
    const on = painted?.on ?? false;
    if (painted) painted.on = false;
    this.markers.object.visible = this.highlight.object.visible = false;
    const image = this.stage.thumbnail(size);
    if (painted) painted.on = on;
    preview?.hide(hidden);
    this.show(this.wanted);
    return image;
  }

  /** The same of a head that is not on the stage, of its face or still model. Resolves with what draws it, in a frame hook. */
  async portraitOf(model: Model, still: StillFace | Uint8Array, size: number): Promise<() => string> {
    if (still instanceof Uint8Array) {
      const preview = await PreviewView.load(still, this.quality.richSkin);
      const head = preview.head((part) => model.parts.find(({ index }) => index === part)?.role ?? null);
      return () => {
        const image = this.stage.portrait(preview.object, { head, points: [] }, size);
        preview.dispose();
        return image;
      };
    }
    const { mesh, rig } = still;
    const view = new FaceView(mesh, await makeMaterials(still.materials, this.quality.richSkin, mesh.colors !== null));
    view.usePath('wasm'); // at rest, without a pose
    const framing = { head: framedHead([{ positions: mesh.positions, triangles: mesh.indices }]), points: rig.feature_points.map(({ position }) => position) };
    return () => {
      const image = this.stage.portrait(view.object, framing, size);
      view.dispose();
      disposeMaterials(view.materials);
      return image;
    };
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
    if (this.preview && this.previewKey === previewKeyOf(model)) return this.preview;
    return PreviewView.load(await this.sources.preview(model, signal), this.quality.richSkin);
  }

  /** Loads the still model of the shown face, once it is to be seen. */
  private async fetchPreview(): Promise<void> {
    const { model, opening } = this;
    if (this.preview || model?.state !== 'parametrized' || !opening || this.state.value.kind !== 'ready') return; // another head has no face that this follows
    this.state.set({ kind: 'loading', title: t('Opening the head') });
    try {
      const preview = await this.openPreview(model, opening.signal);
      if (opening.signal.aborted) return;
      this.setPreview(preview, previewKeyOf(model));
      preview.wireframe = this.wire;
      this.show(this.wanted);
      this.state.set({ kind: 'ready' });
    } catch (error) {
      if (!opening.signal.aborted) this.state.set({ kind: 'failed', problem: problemOf(error) });
    }
  }

  private setPreview(preview: PreviewView | null, key: string): void {
    this.highlight.clear();
    this.preview?.dispose();
    this.preview = preview;
    this.previewKey = key;
    preview?.hide(this.hidden);
    if (preview) this.stage.scene.add(preview.object);
  }

  private async openFace(model: Model, signal: AbortSignal): Promise<{ view: FaceView; loaded: LoadedFace }> {
    const loaded = await this.sources.face(model, this.level.value, signal);
    const materials = await makeMaterials(loaded.materials, this.quality.richSkin, loaded.mesh.colors !== null);
    return { view: new FaceView(loaded.mesh, materials), loaded };
  }

  private install(model: Model, preview: PreviewView | null, face: { view: FaceView; loaded: LoadedFace } | null): void {
    const key = previewKeyOf(model);
    const another = key !== this.framed;
    if (preview && preview !== this.preview) this.setPreview(preview, key);
    this.influence = null;
    this.units = null;
    this.disposeFace();
    this.face = face?.view ?? null;
    this.rig = face?.loaded.rig ?? null;
    this.packageBytes.set(face?.loaded.packageBytes ?? 0);
    if (face) {
      this.stage.scene.add(face.view.object);
      face.view.usePath(this.path);
      face.loaded.kernel.setJawTakesLip(this.lipFollows);
      const performer = new Performer(face.loaded.kernel, this.clock);
      this.pose(face.view, performer);
      this.setPerformer(performer);
    } else {
      this.setPerformer(null);
    }
    this.wireframe = this.wire;
    // A face is best known in three quarters; points are placed from in front.
    const view = face && this.wanted === 'face' ? 'three-quarter' : 'front';
    if (another && preview) {
      const roles = new Map(model.parts.map(({ index, role }) => [index, role]));
      this.stage.frameObject(preview.object, preview.head((part) => roles.get(part) ?? null), view);
    } else if (another && face) {
      const { positions, indices } = face.view.mesh;
      this.stage.frameObject(face.view.object, framedHead([{ positions, triangles: indices }]), view);
    }
    this.framed = key;
    if (this.rig) this.frameByPoints(this.rig.feature_points.map(({ position }) => position), another ? view : 'front');
    this.show(this.wanted);
  }

  /** Goes to the head that the feature points tell, where the outline of the figure did not tell it. */
  frameByPoints(positions: readonly (readonly [number, number, number])[], view: ViewName = 'front'): void {
    const head = headOfPoints(positions, this.stage.framed);
    if (head) this.stage.frameHead(head, view);
  }

  /** Whether FAP 3 alone takes the lower lip along, on this face and those to come. */
  set jawTakesLip(takes: boolean) {
    this.lipFollows = takes;
    this.performer.value?.kernel.setJawTakesLip(takes);
    if (this.twin) this.twin.jawTakesLip = takes;
  }

  /** Makes another scene a second view of the same work: it draws as this one does, and is given up with null. */
  joinTwin(twin: SceneView | null): void {
    this.twin = twin;
    if (!twin) return;
    twin.wireframe = this.wire;
    twin.deformPath = this.path;
    twin.jawTakesLip = this.lipFollows;
  }

  /** Ends the view. */
  dispose(): void {
    this.opening?.abort();
    this.clear();
    this.stage.dispose();
  }

  /** The one before is freed when nobody has it any more. */
  private setPerformer(performer: Performer | null): void {
    const before = this.performer.value;
    this.performer.set(performer);
    before?.dispose();
  }

  private disposeFace(): void {
    if (!this.face) return;
    this.face.dispose();
    disposeMaterials(this.face.materials);
  }

  private clear(): void {
    this.highlight.clear();
    this.influence = null;
    this.units = null;
    this.setPreview(null, '');
    this.framed = '';
    this.disposeFace();
    this.face = null;
    this.rig = null;
    this.packageBytes.set(0);
    this.setPerformer(null);
    this.show(this.wanted);
  }
}

const previewKeyOf = (model: Model): string => `${model.id}:${JSON.stringify(model.frame?.axes)}`;
const packageOf = (model: Model | null): string => model?.package?.parametrization ?? '';

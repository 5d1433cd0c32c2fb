import { featurePoints } from '@protocol/generated/mpeg4.ts';
import { middleOf } from '../../face/mirror_points.ts';
import { PointDraft, type PlacedPoint, type PointChanges, type PointOrNone } from '../../face/point_draft.ts';
import { leastKnownPoints } from '../../face/quick_set.ts';
import { ApiError, featurePointOf, fieldProblems, problemOf } from '../../net/problem.ts';
import type { FeaturePointsBody, FeaturePointSet, Model } from '../../net/types.ts';
import { saveFile } from '../shared/save_file.ts';
import { Signal } from '../shared/signal.ts';
import type { ToastAction } from '../shared/toast.ts';
import type { DraftStore } from './draft_store.ts';
import type { MirrorLock } from './mirror_lock.ts';
import { isQuick, nextPoint, nextProposed, quickLeft } from './point_order.ts';
import { placedPoints, pointsFile, type PositionOf } from './point_set.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/** How saving ended; `overtaken`: someone else had saved since the points were read, and theirs have been taken in. */
type Outcome = 'saved' | 'refused' | 'overtaken';

/** The feature points of the open head: the draft, the selected point, and the server's errors by point. */
export class PointsModel {
  readonly draft = new PointDraft();
  /** Incremented by every change of the draft or the problems. */
  readonly changed = new Signal(0);
  readonly chosen = new Signal<string | null>(null);
  /** Whether the point is being chosen on the head itself, where it is seen already. */
  pickedOnHead = false;
  readonly busy = new Signal(false);
  /** Errors by feature point id; "" holds the errors that concern no single point. */
  problems: ReadonlyMap<string, readonly string[]> = new Map();
  /** Whether the problems are of points of a file, of which none was taken. */
  problemsOfFile = false;
  /** Whether guided mode leads the user through the quick set. */
  readonly guided = new Signal(true);
  /** The points that were changed elsewhere too, each with the server's point that the change here was made over. */
  private disputed: ReadonlyMap<string, PointOrNone> = new Map();
  /** The reasons why points could not be proposed, by id; of the last proposal job. */
  notProposed: ReadonlyMap<string, string> = new Map();
  /** The shape of this head shows no points: it was asked for them. */
  private showsNone = false;
  /** Units set by hand, lengths in model units by name; the server keeps them when points are saved. */
  fapu: FeaturePointSet['fapu'] = {};
  private guidedByUser = false;
  private etag: string | null = null;
  private model: Model | null = null;
  /** The axes of the open head, in one word. */
  private axes = '';
  /** Whether the draft is the open head's, so that its changes are worth keeping. */
  opened = false;
  /** The position of a vertex of the file, model units; used for points that the server returns without a position. */
  positionOf: PositionOf = () => null;

  /** The place on the head for point `id` at the image of another, `middle` being the middle of the head; null: none is near. */
  imageOf: (id: string, of: PlacedPoint, middle: number) => PlacedPoint | null = () => null;

  /** A file of points that was chosen while its head was being read. */
  private waiting: { head: string; file: File } | null = null;

  constructor(
    private readonly studio: Studio,
    private readonly drafts: DraftStore,
    readonly lock: MirrorLock,
  ) {}

  get total(): number {
    return featurePoints.length;
  }

  async open(model: Model | null): Promise<void> {
    this.model = model;
    this.axes = axesOf(model);
    this.opened = false;
    this.chosen.set(null);
    this.clearProblems();
    this.draft.reset([]);
    this.notProposed = new Map();
    this.showsNone = false;
    this.disputed = new Map();
    this.fapu = {};
    this.guidedByUser = false;
    this.etag = null;
    this.touch();
    if (!model || model.state === 'importing' || model.state === 'failed') return;
    const isRead = await this.studio.attempt(t('The feature points could not be read'), async () => {
      const answer = await this.studio.api.getFeaturePoints(model.id);
      if (this.model === model) this.take(answer.value, answer.etag, true);
    });
    if (this.model !== model) return;
    // Without the server's points the kept ones are shown all the same.
    this.bringBack(model.id, isRead);
    const { waiting } = this;
    if (waiting?.head !== model.id) return;
    this.waiting = null;
    await this.importFile(waiting.file);
  }

  /**
   * Takes what someone else has saved since the points were read, and says so. Unsaved changes stay; a point that has been changed on
   * both sides is `contested` until it is decided.
   */
  async update(model: Model): Promise<void> {
    if (this.model?.id !== model.id || !this.opened) return;
    if (this.axes !== axesOf(model)) return this.open(model); // with the axes all positions have changed
    // A request of this page that is under way brings the newest points itself, or is refused.
    if (!this.busy.value) await this.takeNewer(model.id);
  }

  private async takeNewer(head: string): Promise<void> {
    const { etag: known } = this;
    await this.studio.attempt(t('The feature points could not be read'), async () => {
      const { value, etag } = await this.studio.api.getFeaturePoints(head);
      // What this page has saved meanwhile is as new.
      if (this.model?.id !== head || etag === known || this.etag !== known) return;
      const { changed, contested } = this.draft.rebase(placedPoints(value, this.positionOf));
      const unitsChanged = JSON.stringify(this.fapu) !== JSON.stringify(value.fapu);
      this.fapu = value.fapu;
      this.etag = etag;
      this.disputed = new Map([...contested, ...this.disputed]); // a point stays contested over what its first change was made over
      for (const id of changed) this.forgive(id);
      this.touch();
      if (known !== null) this.tellOf(changed.length, unitsChanged);
    });
  }

  private tellOf(changed: number, unitsChanged: boolean): void {
    const { toasts } = this.studio;
    if (this.contested.length > 0) this.tellOfContested();
    else if (changed > 0 && this.draft.changes > 0)
      toasts.say(
        changed === 1
          ? t('Someone else changed 1 point. Your unsaved changes are kept.')
          : t('Someone else changed {changed} points. Your unsaved changes are kept.', { changed }),
      );
    else if (changed > 0)
      toasts.say(changed === 1 ? t('Someone else changed 1 point.') : t('Someone else changed {changed} points.', { changed }));
    else if (unitsChanged) toasts.say(t('Someone else changed the units of the face.'));
  }

  private tellOfContested(): void {
    const { toasts, tab } = this.studio;
    toasts.say(t('Someone else changed points that you have changed too.'), { label: t('Choose'), act: () => tab.set('points') });
  }

  /** The points that someone else has changed while they had unsaved changes here, which are shown. */
  get contested(): string[] {
    return [...this.disputed.keys()].filter((id) => this.draft.isChanged(id));
  }

  /** Decides about the contested points: `theirs` replace the own ones, as a step that can be undone, or the own ones stay, to be saved. */
  settle(theirs: boolean): void {
    if (theirs) this.draft.takeSaved(this.contested);
    this.disputed = new Map();
    this.touch();
  }

  /** Takes the unsaved changes of an earlier visit into the draft, as a step that can be undone. `isRead`: the server's points are known. */
  private bringBack(head: string, isRead: boolean): void {
    const back = this.wayBack();
    this.disputed = this.draft.restore(this.drafts.read(head, this.axes), isRead);
    this.opened = true;
    this.touch();
    const { changes } = this.draft;
    if (changes === 0) return;
    if (this.contested.length > 0) return this.tellOfContested();
    this.studio.toasts.say(changes === 1 ? t('Your unsaved point is back.') : t('Your {changes} unsaved points are back.', { changes }), {
      label: t('Discard'),
      act: back,
    });
  }

  /** What puts the points of now back, whatever is done until then; in itself a step that can be undone. */
  private wayBack(): () => void {
    const { model } = this;
    const before = new Map(this.draft.points);
    return () => {
      if (this.model !== model) return;
      this.draft.replace(before);
      this.touch();
    };
  }

  /** Places the chosen point, and with it the one that moves with it. */
  place(point: PlacedPoint): void {
    const id = this.chosen.value;
    if (id === null) return;
    const isNew = !this.draft.points.has(id);
    this.put(id, point);
    this.touch();
    if (isNew && this.guided.value) this.chooseNext();
  }

  /** Moves a placed point, and selects it. */
  move(id: string, point: PlacedPoint): void {
    this.put(id, point);
    this.chosen.set(id);
    this.touch();
  }

  /** Moves points to given places, as one step; what else moves with them stays. */
  moveAll(places: readonly (readonly [string, PlacedPoint])[]): void {
    this.draft.placeAll(places);
    for (const [id] of places) this.forgive(id);
    this.touch();
  }

  private put(id: string, point: PlacedPoint): void {
    const twin = this.twinOf(id, point);
    this.draft.placeAll(twin ? [[id, point], twin] : [[id, point]]);
    this.forgive(id);
    if (twin) this.forgive(twin[0]);
  }

  /** The point that moves with this one, and where it goes when this one goes to `point`; null: none. */
  twinOf(id: string, point: PlacedPoint): [string, PlacedPoint] | null {
    const twin = this.lock.twinOf(id);
    if (twin === null) return null;
    const at = this.imageOf(twin, point, middleOf(this.draft.points));
    return at ? [twin, at] : null;
  }

  /** Chooses a point by its marker on the head. */
  pick(id: string): void {
    this.pickedOnHead = true;
    this.chosen.set(id);
    this.pickedOnHead = false;
  }

  toggle(id: string): void {
    this.chosen.set(this.chosen.value === id ? null : id);
  }

  guide(on: boolean): void {
    this.guidedByUser = true;
    this.guided.set(on);
  }

  get quickLeft(): number {
    return quickLeft(this.draft.points);
  }

  /** The first point to place, also when a later one is chosen. */
  chooseFirst(): void {
    this.chosen.set(null);
    this.chooseNext();
  }

  /** Whether `chooseNext` has a point: an unplaced one, or a proposed one to review. */
  get hasNext(): boolean {
    if (this.guided.value) return this.quickLeft > 0;
    return this.draft.points.size < this.total || this.draft.proposed.length > 0;
  }

  confirmAndNext(id: string): void {
    this.draft.confirm([id]);
    this.touch();
    this.chooseNextProposed();
  }

  confirmAll(): void {
    this.draft.confirm(this.draft.proposed);
    this.touch();
  }

  discardProposals(): void {
    const chosen = this.chosen.value;
    if (chosen !== null && this.draft.points.get(chosen)?.proposal) this.chosen.set(null);
    this.draft.discard(this.draft.proposed);
    this.touch();
  }

  chooseNextProposed(): void {
    this.chosen.set(nextProposed(this.draft.points, this.chosen.value));
  }

  /** Removes a point, and the one that moves with it. */
  remove(id: string): void {
    const ids = [id, this.lock.twinOf(id)].filter((one) => one !== null);
    this.draft.remove(...ids);
    for (const one of ids) this.forgive(one);
    this.touch();
  }

  undo(): void {
    this.travel(() => this.draft.undo());
  }

  redo(): void {
    this.travel(() => this.draft.redo());
  }

  private travel(step: () => boolean): void {
    const before = this.draft.points;
    if (!step()) return;
    for (const id of this.problems.keys()) if (before.get(id) !== this.draft.points.get(id)) this.forgive(id);
    this.touch();
  }

  /** Selects the next point to place in the current order or, when all are placed, the next proposed one. */
  chooseNext(): void {
    this.chosen.set(nextPoint(this.draft.points, this.chosen.value, this.guided.value));
  }

  /** Saves the draft and starts a job that proposes the missing points. */
  async propose(): Promise<void> {
    const { model, studio } = this;
    if (!model || (this.draft.changes > 0 && !(await this.save()))) return;
    this.busy.set(true);
    const done = await studio.attempt(t('No points were proposed'), async () => {
      const result = await this.unlessOvertaken(model, studio.propose(model, this.etag));
      if (result === null || this.model?.id !== model.id) return;
      const answer = await studio.api.getFeaturePoints(model.id);
      this.notProposed = new Map(Object.entries(result.not_proposed));
      this.guidedByUser = false;
      this.take(answer.value, answer.etag);
      await studio.reload(model.id);
      const { length } = this.draft.proposed;
      studio.toasts.say(length > 0 ? t('{count} points are proposed: review them.', { count: length }) : t('No point could be proposed.'));
    });
    this.showsNone ||= !done && this.model?.id === model.id && this.draft.points.size === 0;
    this.busy.set(false);
    this.touch();
  }

  /** When someone else has saved meanwhile, both changes are saved, unless they are of the same point. */
  async save(mirror = false): Promise<boolean> {
    const failure = mirror ? t('The missing sides were not filled in') : t('The feature points were not saved');
    const send = (): Promise<Outcome> => this.send(this.draft.toBody(), failure, { mirror });
    let outcome = await send();
    if (outcome === 'overtaken' && this.contested.length === 0) outcome = await send();
    if (outcome === 'overtaken') this.sayOvertaken(failure);
    return outcome === 'saved';
  }

  private sayOvertaken(failure: string): void {
    this.studio.toasts.problem(failure, { type: 'about:blank', title: t('Someone else has saved points meanwhile.'), status: 412 });
  }

  /** Gives a unit (FAPU) by hand, a length in model units; null: it is measured again. Unsaved points stay as they are. */
  async setUnit(unit: string, length: number | null): Promise<boolean> {
    const { model } = this;
    if (!model) return false;
    this.busy.set(true);
    const done = await this.studio.attempt(t('The unit was not changed'), async () => {
      const body = { points: {}, fapu: { [unit]: length } };
      const answer = await this.unlessOvertaken(model, this.studio.api.patchFeaturePoints(model.id, body, this.etag));
      if (this.model?.id !== model.id) return;
      this.fapu = answer.value.fapu;
      this.etag = answer.etag;
    });
    this.busy.set(false);
    this.touch();
    return done;
  }

  /** Uploads a file of the form {"points": {"2.1": {"vertex": 12, "position": [..]}}}; the server validates it. While the head is being read it waits. */
  async importFile(file: File): Promise<boolean> {
    if (this.model?.state === 'importing') {
      this.waiting = { head: this.model.id, file };
      this.studio.toasts.say(t('{name} is taken when the head has been read.', { name: file.name }));
      return false;
    }
    let body: FeaturePointsBody;
    try {
      body = JSON.parse(await file.text()) as FeaturePointsBody;
    } catch (error) {
      this.setProblems({ '': [t('{name} is not JSON: {message}', { name: file.name, message: error instanceof Error ? error.message : '' })] });
      return false;
    }
    return this.importPoints(body, file.name);
  }

  private async importPoints(body: FeaturePointsBody, name: string): Promise<boolean> {
    const { model } = this;
    const back = this.wayBack();
    const failure = t('The points of {name} were not accepted', { name });
    const outcome = await this.send(body, failure, { others: (refused) => {
      const others = Object.entries(body.points).filter(([id]) => !refused.has(id));
      if (others.length === 0) return undefined;
      const act = (): void => {
        if (this.model?.id === model?.id) void this.importPoints({ ...body, points: Object.fromEntries(others) }, name);
      };
      return { label: t('Take the other {count}', { count: others.length }), act };
    } });
    if (outcome === 'overtaken') this.sayOvertaken(failure);
    if (outcome === 'saved')
      this.studio.toasts.say(t('{count} feature points read from {name}.', { count: this.draft.points.size, name }), {
        label: t('Undo'),
        act: back,
      });
    return outcome === 'saved';
  }

  exportFile(): void {
    const name = this.model?.name ?? '';
    saveFile(pointsFile(name, this.draft.points), `${(name || 'head').replaceAll(/[^\p{L}\p{N}._-]+/gu, '-')}.fps.json`);
  }

  /** Shows the errors of a refused request beside the points that they name. */
  show(error: unknown): void {
    const problem = problemOf(error);
    const byPoint: Record<string, string[]> = {};
    for (const { pointer, detail } of fieldProblems(problem))
      (byPoint[featurePointOf(pointer) ?? ''] ??= []).push(pointer ? `${detail} (${pointer})` : detail);
    this.setProblems(byPoint);
    const first = Object.keys(byPoint).find((id) => id !== '');
    if (first) this.chosen.set(first);
  }

  /** Whether enough points are placed for proposals. */
  get canPropose(): boolean {
    return this.draft.points.size - this.draft.proposed.length >= leastKnownPoints;
  }

  /** Whether the points can be asked for of the shape of the head: nobody has placed any. */
  get canFind(): boolean {
    return this.model !== null && this.draft.points.size === 0 && !this.showsNone;
  }

  /** Exchanges these points with their mirror points in the draft, without saving. */
  exchange(ids: readonly string[]): void {
    this.draft.exchange(ids);
    this.touch();
  }

  /** `others`: of points that the panel does not show, what can be done without those that were refused. */
  private async send(
    body: FeaturePointsBody,
    failure: string,
    { mirror = false, others }: { mirror?: boolean; others?: (refused: ReadonlyMap<string, unknown>) => ToastAction | undefined } = {},
  ): Promise<Outcome> {
    const model = this.model;
    if (!model) return 'refused';
    this.busy.set(true);
    try {
      const answer = await this.unlessOvertaken(model, this.studio.api.putFeaturePoints(model.id, body, { etag: this.etag, mirror }));
      this.clearProblems();
      this.take(answer.value, answer.etag);
      await this.studio.reload(model.id);
      return 'saved';
    } catch (error) {
      if (isOvertaken(error)) return 'overtaken';
      this.problemsOfFile = others !== undefined;
      this.show(error);
      const named = [...this.problems.keys()].some((id) => id !== '');
      if (!(error instanceof ApiError) || !named) this.studio.toasts.problem(failure, problemOf(error));
      else if (others) this.studio.toasts.problem(failure, problemOf(error), others(this.problems));
      return 'refused';
    } finally {
      this.busy.set(false);
    }
  }

  /** Waits for a request that the server refuses when its points are newer than those of this page; then takes the newer ones and throws. */
  private async unlessOvertaken<T>(model: Model, request: Promise<T>): Promise<T> {
    try {
      return await request;
    } catch (error) {
      if (isOvertaken(error)) await this.takeNewer(model.id);
      throw error;
    }
  }

  /** `fresh`: of a head that has just been opened; otherwise what was done before can be undone. */
  private take(set: FeaturePointSet, etag: string | null, fresh = false): void {
    const placed = placedPoints(set, this.positionOf);
    this.fapu = set.fapu;
    this.disputed = new Map();
    if (fresh) this.draft.reset(placed);
    else this.draft.accept(placed);
    // With points beyond the quick set, or with proposals to review, the user needs the whole list.
    if (!this.guidedByUser) this.guided.set(placed.every(([id, point]) => isQuick(id) && !point.proposal));
    this.etag = etag;
    this.touch();
  }

  private forgive(id: string): void {
    const rest = new Map(this.problems);
    rest.delete(id);
    rest.delete('');
    this.problems = rest;
  }

  private clearProblems(): void {
    this.problems = new Map();
  }

  private setProblems(problems: Record<string, string[]>): void {
    this.problems = new Map(Object.entries(problems));
    this.touch();
  }

  private touch(): void {
    if (this.opened && this.model) this.drafts.keep(this.model.id, this.axes, this.keptChanges());
    this.changed.set(this.changed.value + 1);
  }

  /** What is contested stays so after a reload. */
  private keptChanges(): PointChanges {
    const changes = this.draft.changed;
    for (const [id, over] of this.disputed) {
      const change = changes.get(id);
      if (change) changes.set(id, { ...change, over });
    }
    return changes;
  }
}

const axesOf = (model: Model | null): string => JSON.stringify(model?.frame?.axes ?? null);

const isOvertaken = (error: unknown): boolean => error instanceof ApiError && error.problem.status === 412;

import { featurePoints } from '@protocol/generated/mpeg4.ts';
import { PointDraft, type PlacedPoint } from '../face/point_draft.ts';
import { leastKnownPoints } from '../face/quick_set.ts';
import { ApiError, featurePointOf, fieldProblems, problemOf } from '../net/problem.ts';
import type { FeaturePointSet, Model } from '../net/types.ts';
import { Signal } from './signal.ts';
import type { Studio } from './studio.ts';

/** Feature points of the open head: the draft, the chosen point, and what the server said against any of them. */
export class PointsModel {
  readonly draft = new PointDraft();
  /** Counts up with every change of the draft or the problems. */
  readonly changed = new Signal(0);
  readonly chosen = new Signal<string | null>(null);
  readonly busy = new Signal(false);
  /** Reasons by feature point id; "" holds what concerns no point. */
  problems: ReadonlyMap<string, readonly string[]> = new Map();
  warnings: readonly string[] = [];
  private etag: string | null = null;
  private model: Model | null = null;
  /** A vertex of the file in model units: asked for points whose answer names no position. */
  positionOf: (vertex: number) => readonly [number, number, number] | null = () => null;

  constructor(private readonly studio: Studio) {}

  get total(): number {
    return featurePoints.length;
  }

  async open(model: Model | null): Promise<void> {
    this.model = model;
    this.chosen.set(null);
    this.clearProblems();
    this.draft.reset([]);
    this.etag = null;
    this.touch();
    if (!model || model.state === 'importing' || model.state === 'failed') return;
    await this.studio.attempt('The feature points could not be read', async () => {
      const answer = await this.studio.api.getFeaturePoints(model.id);
      if (this.model?.id === model.id) this.take(answer.value, answer.etag);
    });
  }

  place(vertex: number, position: readonly [number, number, number]): void {
    const id = this.chosen.value;
    if (id === null) return;
    this.draft.place(id, { vertex, position });
    this.forgive(id);
    this.touch();
  }

  remove(id: string): void {
    this.draft.remove(id);
    this.forgive(id);
    this.touch();
  }

  undo(): void {
    if (this.draft.undo()) this.touch();
  }

  redo(): void {
    if (this.draft.redo()) this.touch();
  }

  /** The next unplaced point after the chosen one, in the standard's order. */
  chooseNext(): void {
    const start = featurePoints.findIndex((point) => point.id === this.chosen.value);
    for (let i = 1; i <= featurePoints.length; i += 1) {
      const point = featurePoints[(start + i) % featurePoints.length]!;
      if (!this.draft.points.has(point.id)) {
        this.chosen.set(point.id);
        return;
      }
    }
  }

  save(mirror = false): Promise<boolean> {
    return this.put(
      this.draft.toBody(),
      mirror ? 'The missing sides were not filled in' : 'The feature points were not saved',
      { mirror, guarded: true },
    );
  }

  /** A file in the form {"points": {"2.1": {"vertex": 12, "position": [..]}}}; the server reads it. */
  async importFile(file: File): Promise<boolean> {
    let body: unknown;
    try {
      body = JSON.parse(await file.text());
    } catch (error) {
      this.setProblems({ '': [`${file.name} is not JSON: ${error instanceof Error ? error.message : ''}`] });
      return false;
    }
    const done = await this.put(body, `The points of ${file.name} were not accepted`, { mirror: false, guarded: true });
    if (done) this.studio.toasts.say(`${this.draft.points.size} feature points read from ${file.name}.`);
    return done;
  }

  exportFile(): void {
    const points: Record<string, PlacedPoint> = {};
    for (const { id } of featurePoints) {
      const point = this.draft.points.get(id);
      if (point) points[id] = point;
    }
    const text = JSON.stringify({ head: this.model?.name ?? '', count: this.draft.points.size, points }, null, 1);
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([text], { type: 'application/json' }));
    link.download = `${(this.model?.name ?? 'head').replaceAll(/[^\p{L}\p{N}._-]+/gu, '-')}.fps.json`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  /** Shows a refusal beside the points it names. */
  show(error: unknown): void {
    const problem = problemOf(error);
    const byPoint: Record<string, string[]> = {};
    for (const { pointer, detail } of fieldProblems(problem))
      (byPoint[featurePointOf(pointer) ?? ''] ??= []).push(pointer ? `${detail} (${pointer})` : detail);
    this.setProblems(byPoint);
    const first = Object.keys(byPoint).find((id) => id !== '');
    if (first) this.chosen.set(first);
  }

  /** Whether proposals can be made: from fewer points than this nothing can be told. */
  get canPropose(): boolean {
    return this.draft.points.size - this.draft.proposed.length >= leastKnownPoints;
  }

  /** Exchanges left and right of these points; not saved yet. */
  exchange(ids: readonly string[]): void {
    this.draft.exchange(ids);
    this.touch();
  }

  private async put(body: unknown, failure: string, options: { mirror: boolean; guarded: boolean }): Promise<boolean> {
    const model = this.model;
    if (!model) return false;
    this.busy.set(true);
    try {
      const answer = await this.studio.api.putFeaturePoints(model.id, body, {
        etag: options.guarded ? this.etag : null,
        mirror: options.mirror,
      });
      this.clearProblems();
      if (answer.value?.points) this.take(answer.value, answer.etag);
      else {
        const now = await this.studio.api.getFeaturePoints(model.id);
        this.take(now.value, now.etag);
      }
      await this.studio.reload(model.id);
      return true;
    } catch (error) {
      this.show(error);
      const named = [...this.problems.keys()].some((id) => id !== '');
      if (!(error instanceof ApiError) || !named) this.studio.toasts.problem(failure, problemOf(error));
      return false;
    } finally {
      this.busy.set(false);
    }
  }

  private take(set: FeaturePointSet, etag: string | null): void {
    const placed: [string, PlacedPoint][] = [];
    for (const [id, value] of Object.entries(set.points)) {
      const vertex = value.vertex ?? null;
      const position = value.position ?? (vertex === null ? null : this.positionOf(vertex));
      if (position) placed.push([id, { vertex, position }]);
    }
    this.draft.reset(placed);
    this.warnings = set.warnings ?? [];
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
    this.warnings = [];
  }

  private setProblems(problems: Record<string, string[]>): void {
    this.problems = new Map(Object.entries(problems));
    this.touch();
  }

  private touch(): void {
    this.changed.set(this.changed.value + 1);
  }
}

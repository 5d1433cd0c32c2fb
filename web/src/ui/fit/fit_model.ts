import { problemOf } from '../../net/problem.ts';
import type { Finding, FitReport, Model, Problem } from '../../net/types.ts';
import { Signal } from '../shared/signal.ts';
import type { Studio } from '../shared/studio.ts';

export type ReportState =
  { kind: 'none' } | { kind: 'loading' } | { kind: 'ready'; report: FitReport } | { kind: 'failed'; problem: Problem };

/** The fit doctor's report of the open head, and the finding or part that is highlighted on the stage. */
export class FitModel {
  readonly report = new Signal<ReportState>({ kind: 'none' });
  readonly chosen = new Signal<Finding | null>(null);
  /** Index of the selected part. */
  readonly part = new Signal<number | null>(null);
  /** The part under the pointer or with the keyboard focus; highlighted in place of the selection. */
  readonly hoveredPart = new Signal<number | null>(null);
  private shown = '';

  constructor(private readonly studio: Studio) {
    studio.selected.watch((model) => void this.open(model));
  }

  /** Selects a finding, or none. */
  choose(finding: Finding | null): void {
    this.part.set(null);
    this.chosen.set(finding);
  }

  choosePart(part: number | null): void {
    this.chosen.set(null);
    this.part.set(part);
  }

  private async open(model: Model | null): Promise<void> {
    const has = model !== null && (model.state === 'ready' || model.state === 'parametrized') && !!model.findings;
    // Every job and edit that may change the report also changes the model's update time.
    const key = has ? `${model.id} ${model.updated}` : '';
    if (key === this.shown) return;
    const another = key.split(' ')[0] !== this.shown.split(' ')[0];
    this.shown = key;
    if (another) {
      this.choose(null);
      this.hoveredPart.set(null);
    }
    if (!has) return this.report.set({ kind: 'none' });
    if (another) this.report.set({ kind: 'loading' });
    try {
      const report = await this.studio.api.getReport(model.id);
      if (this.shown !== key) return;
      this.choose(null);
      this.report.set({ kind: 'ready', report });
    } catch (error) {
      if (this.shown === key) this.report.set({ kind: 'failed', problem: problemOf(error) });
    }
  }
}

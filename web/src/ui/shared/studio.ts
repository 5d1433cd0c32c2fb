import type { Api } from '../../net/api.ts';
import { headUploads, type PathFile } from '../../net/head_files.ts';
import { followJob } from '../../net/jobs.ts';
import { ApiError, problemOf } from '../../net/problem.ts';
import type { ExtractionOptions, FrameWish, Job, Model, ParametrizationOptions, PartRole, Problem, ProposalsResult, WornEdit } from '../../net/types.ts';
import { JobStore } from './job_store.ts';
import { stageTitle } from './names.ts';
import { Signal } from './signal.ts';
import type { Toasts } from './toast.ts';
import { t } from '../../words/words.ts';

export type Tab = 'heads' | 'fit' | 'points' | 'animate' | 'live';

/** A running operation, shown with a progress bar. `progress` is 0..1, or null while unknown. */
export interface Activity {
  title: string;
  progress: number | null;
  cancel?: () => void;
}

/** A file that was chosen; `key`: of its activity. */
interface Upload {
  file: File;
  key: string;
  abort: AbortController;
}

export type ShelfState = { kind: 'loading' } | { kind: 'ready' } | { kind: 'failed'; problem: Problem };

/** The page's state apart from the stage: the models and the operations on them. */
export class Studio {
  readonly models = new Signal<readonly Model[]>([]);
  readonly shelf = new Signal<ShelfState>({ kind: 'loading' });
  readonly selected = new Signal<Model | null>(null);
  readonly tab = new Signal<Tab>('animate');
  /** Running operations by model id; an upload has a temporary id until the server has assigned one. */
  readonly activities = new Signal<ReadonlyMap<string, Activity>>(new Map());
  /** Called when a head was deleted. */
  onRemoved: (id: string) => void = () => {};
  /** Called when someone else has changed the open head. */
  onChangedElsewhere: (model: Model) => void = () => {};
  private uploads = 0;
  /** Heads that this page is deleting now. */
  private readonly deleting = new Set<string>();
  /** Heads that are read again in other axes. */
  private readonly turning = new Set<string>();

  constructor(
    readonly api: Api,
    readonly toasts: Toasts,
    private readonly jobs = new JobStore(null),
  ) {}

  /** Loads the shelf, and goes on with what was at work when the page was left or its server went away. */
  async start(): Promise<void> {
    if (!(await this.refresh())) return;
    for (const model of this.models.value) if (model.state === 'importing') void this.waitForImport(model.id);
    for (const [head, job] of this.jobs.read()) if (!this.activities.value.has(head)) void this.resume(head, job);
  }

  async refresh(): Promise<boolean> {
    try {
      const models = await this.api.listModels();
      this.models.set(models);
      this.shelf.set({ kind: 'ready' });
      return true;
    } catch (error) {
      this.shelf.set({ kind: 'failed', problem: problemOf(error) });
      return false;
    }
  }

  /** Takes in what others have uploaded, changed or deleted since the list was read. */
  async update(): Promise<void> {
    const { value: before } = this.models;
    const { value: working } = this.activities;
    let listed: readonly Model[];
    try {
      listed = await this.api.listModels();
    } catch {
      return; // the next time will tell
    }
    if (this.models.value !== before || this.deleting.size > 0) return; // this page has changed it meanwhile
    const known = new Map(before.map((model) => [model.id, model]));
    // What is known has all parts of a head; a list has the largest ones.
    const models = listed.map((model) => {
      const own = known.get(model.id);
      return own?.updated === model.updated && own.state === model.state ? own : model;
    });
    if (models.length === before.length && models.every((model, i) => model === before[i])) return;
    this.models.set(models);
    for (const { id, state } of models) if (state === 'importing' && !this.activities.value.has(id)) void this.waitForImport(id);
    const { value: open } = this.selected;
    if (!open) return;
    const now = models.find(({ id }) => id === open.id);
    if (!now) {
      this.forget(open);
      this.toasts.say(t('{name} was deleted elsewhere.', { name: open.name }));
    } else if (now.updated !== open.updated || now.state !== open.state) {
      const model = await this.reload(open.id);
      if (!model || this.selected.value?.id !== open.id || working.has(open.id)) return;
      this.onChangedElsewhere(model);
      if (model.package?.parametrization !== open.package?.parametrization)
        this.toasts.say(open.package ? t('{name} was parametrized elsewhere.', { name: model.name }) : t('{name} can move now.', { name: model.name }));
    }
  }

  select(id: string): void {
    const model = this.models.value.find((m) => m.id === id) ?? null;
    this.selected.set(model);
    if (!model) return;
    // A list has only the largest parts of each model.
    if (model.parts.length < model.counts.parts) void this.reload(id);
    // Open the tab of the next step: placing points, or animating the face.
    const { value: tab } = this.tab;
    if (model.state === 'ready' && tab !== 'points' && tab !== 'fit') this.tab.set('points');
    else if (model.state === 'parametrized' && tab !== 'live' && tab !== 'fit') this.tab.set('animate');
  }

  /** Uploads the models among these files, each with the files that it refers to. */
  async upload(files: readonly PathFile[]): Promise<void> {
    let uploads: File[];
    try {
      uploads = await headUploads(files);
    } catch (error) {
      this.toasts.problem(t('The files could not be read'), problemOf(error));
      return;
    }
    await this.sendAll(uploads);
  }

  /** Sends files one by one and opens the first. */
  private async sendAll(uploads: readonly File[]): Promise<void> {
    const earlier = this.refusals.splice(0);
    const waiting = uploads.map((file) => this.queueUpload(file));
    const imports: Promise<void>[] = [];
    for (const upload of waiting) {
      const accepted = await this.send(upload, earlier);
      if (!accepted) continue;
      // Whoever works on the first of several files is not taken to the next one.
      if (imports.length === 0) this.select(accepted.model.id);
      imports.push(this.followImport(upload.file, accepted.model, accepted.job));
    }
    await Promise.all(imports);
    this.refusals.push(...earlier);
  }

  /** What takes away the messages of files that were not accepted and that no later choice of files has replaced. */
  private readonly refusals: (() => void)[] = [];

  /** Shows a file that is to be sent when those before it have been. */
  private queueUpload(file: File): Upload {
    this.uploads += 1;
    const upload = { file, key: `upload-${this.uploads}`, abort: new AbortController() };
    this.setActivity(upload.key, {
      title: t('Waiting: {name}', { name: file.name }),
      progress: null,
      cancel: () => {
        upload.abort.abort();
        this.setActivity(upload.key, null);
      },
    });
    return upload;
  }

  /** Sends a file; resolves with null when it is cancelled or not accepted. `earlier`: of `refusals`, those of files that were chosen before. */
  private async send({ file, key, abort }: Upload, earlier: (() => void)[]): Promise<{ model: Model; job: Job } | null> {
    if (abort.signal.aborted) return null;
    const show = (fraction: number): void =>
      this.setActivity(key, { title: t('Sending {name}', { name: file.name }), progress: fraction, cancel: () => abort.abort() });
    show(0);
    try {
      const accepted = await this.api.uploadModel(file, show, abort.signal);
      for (const forget of earlier.splice(0)) forget(); // they would cover the head that came in their place
      this.replaceModel(accepted.model);
      return accepted;
    } catch (error) {
      if (!(error instanceof DOMException && error.name === 'AbortError')) {
        const problem = problemOf(error);
        const again = problem.status === 0 ? { label: t('Try again'), act: () => void this.sendAll([file]) } : undefined;
        this.refusals.push(this.toasts.problem(t('{name} was not accepted', { name: file.name }), problem, again));
      }
      return null;
    } finally {
      this.setActivity(key, null);
    }
  }

  private async followImport(file: File, model: Model, job: Job): Promise<void> {
    await this.attempt(t('{name} could not be read', { name: file.name }), async () => {
      await this.follow(model.id, job, t('Reading the file'));
      const finished = await this.reload(model.id);
      // The stage says it of the head that is on it.
      if (finished?.state === 'failed' && finished.problem && this.selected.value?.id !== finished.id)
        this.toasts.problem(t('{name} could not be read', { name: file.name }), finished.problem);
    });
  }

  async rename(model: Model, name: string): Promise<void> {
    await this.attempt(t('The head was not renamed'), async () =>
      this.replaceModel(await this.api.renameModel(model.id, name)),
    );
  }

  async setRole(model: Model, part: number, role: PartRole | null): Promise<boolean> {
    return this.attempt(t('The role was not changed'), async () =>
      this.replaceModel(await this.api.setRoles(model.id, { [part]: role })),
    );
  }

  /** Sets the unit or the axes of a head; a change of axes imports its file again. */
  async setFrame(model: Model, wish: FrameWish): Promise<void> {
    this.turning.add(model.id);
    await this.attempt(t('Unit and axes were not changed'), async () => {
      const { model: now, job } = await this.api.setFrame(model.id, wish);
      this.replaceModel(now);
      if (!job) return;
      await this.follow(model.id, job, t('Rotating the head'));
      await this.reload(model.id);
    });
    this.turning.delete(model.id);
  }

  async remove(model: Model): Promise<void> {
    this.deleting.add(model.id);
    await this.attempt(t('The head was not deleted'), async () => {
      await this.api.deleteModel(model.id);
      this.forget(model);
      this.toasts.say(t('{name} was deleted.', { name: model.name }));
    });
    this.deleting.delete(model.id);
  }

  /** Takes a head that is gone from the list; if it was open, another one opens. */
  private forget(model: Model): void {
    this.onRemoved(model.id);
    this.models.set(this.models.value.filter((m) => m.id !== model.id));
    if (this.selected.value?.id !== model.id) return;
    const next = this.models.value[0];
    if (next) this.select(next.id);
    else this.selected.set(null);
  }

  /** Computes weights and package. Resolves with whether the job succeeded; throws ApiError when points are refused. */
  async parametrize(model: Model, options: ParametrizationOptions): Promise<boolean> {
    const job = await this.api.parametrize(model.id, options);
    this.jobs.keep(model.id, job.id);
    return this.finish(model.id, job);
  }

  /** Follows a parametrization to its end. Resolves with whether it succeeded; throws ApiError. */
  private async finish(id: string, job: Job): Promise<boolean> {
    const last = await this.follow(id, job, t('Parametrizing'));
    this.jobs.forget(id);
    await this.reload(id);
    if (last.state === 'failed')
      throw new ApiError(last.problem ?? { type: 'about:blank', title: t('The parametrization failed'), status: 500 });
    return last.state === 'done';
  }

  /** Goes on with a parametrization that is not followed any more. */
  private async resume(id: string, jobId: string): Promise<void> {
    const head = this.models.value.find((model) => model.id === id);
    if (!head) return this.jobs.forget(id);
    let job: Job;
    try {
      job = await this.api.getJob(jobId);
    } catch (error) {
      if (problemOf(error).status === 404) this.jobs.forget(id);
      return;
    }
    await this.attempt(t('The head was not parametrized'), async () => {
      if (await this.finish(id, job)) this.toasts.say(t('{name} can move now.', { name: head.name }));
    });
  }

  /** Proposes missing feature points. Resolves with the result, or null when cancelled; throws ApiError. */
  async propose(model: Model, etag: string | null): Promise<ProposalsResult | null> {
    const job = await this.api.proposePoints(model.id, etag);
    const last = await this.follow(model.id, job, t('Proposing points'));
    if (last.state === 'failed')
      throw new ApiError(last.problem ?? { type: 'about:blank', title: t('The proposals failed'), status: 500 });
    return last.state === 'done' && last.result !== null && 'proposed' in last.result ? last.result : null;
  }

  /** Takes a displacement set from a scan of the head. Resolves with its id, or null when cancelled; throws ApiError. */
  async readExpression(model: Model, file: File, options: ExtractionOptions): Promise<string | null> {
    const job = await this.api.createExpression({ ...options, model: model.id }, file);
    const last = await this.follow(model.id, job, t('Reading {name}', { name: file.name }));
    if (last.state === 'failed')
      throw new ApiError(last.problem ?? { type: 'about:blank', title: t('The scan could not be read'), status: 500 });
    return last.state === 'done' && last.result !== null && 'expression' in last.result ? last.result.expression : null;
  }

  /** Lets the head wear other visemes and expressions, with which its package is made again. */
  wear(model: Model, expressions: WornEdit): Promise<boolean> {
    return this.attempt(t('The expressions were not changed'), async () => {
      const { model: now, job } = await this.api.wear(model.id, expressions);
      this.replaceModel(now);
      const last = job && (await this.follow(model.id, job, t('Parametrizing')));
      await this.reload(model.id);
      if (last?.state === 'failed')
        throw new ApiError(last.problem ?? { type: 'about:blank', title: t('The parametrization failed'), status: 500 });
    });
  }

  async reload(id: string): Promise<Model | null> {
    try {
      const model = await this.api.getModel(id);
      this.replaceModel(model);
      return model;
    } catch (error) {
      this.toasts.problem(t('The head could not be read again'), problemOf(error));
      return null;
    }
  }

  /** Runs an action and shows a failure as a message. Resolves with whether it succeeded. */
  async attempt(what: string, action: () => Promise<void>): Promise<boolean> {
    try {
      await action();
      return true;
    } catch (error) {
      this.toasts.problem(what, problemOf(error));
      return false;
    }
  }

  /** Follows a job of a model to its end and shows it as the model's activity. */
  private async follow(model: string, job: Job, title: string): Promise<Job> {
    const cancel = (): void => void this.attempt(t('The job was not cancelled'), () => this.api.cancelJob(job.id));
    try {
      return await followJob(this.api, job, (now) =>
        this.setActivity(model, {
          title: now.stage ? stageTitle(now.stage) : title,
          progress: now.state === 'queued' ? null : now.progress,
          cancel,
        }),
      );
    } finally {
      this.setActivity(model, null);
    }
  }

  private async waitForImport(id: string): Promise<void> {
    this.setActivity(id, { title: t('Reading the file'), progress: null });
    for (;;) {
      await new Promise((wake) => setTimeout(wake, 700));
      const model = await this.reload(id);
      if (!model || model.state !== 'importing') break;
    }
    this.setActivity(id, null);
  }

  private setActivity(key: string, activity: Activity | null): void {
    const next = new Map(this.activities.value);
    if (activity) next.set(key, activity);
    else next.delete(key);
    this.activities.set(next);
  }

  private replaceModel(model: Model): void {
    const known = this.models.value.some((m) => m.id === model.id);
    this.models.set(
      known ? this.models.value.map((m) => (m.id === model.id ? model : m)) : [model, ...this.models.value],
    );
    const open = this.selected.value;
    if (open?.id !== model.id) return;
    this.selected.set(model);
    // The open head has just been imported: the next step is placing points, unless the file has errors. Who turned it goes on where it was asked.
    if (open.state === 'importing' && model.state === 'ready' && this.tab.value !== 'fit' && !this.turning.has(model.id))
      this.tab.set(hasErrors(model) ? 'fit' : 'points');
  }
}

/** Whether the fit doctor found errors. Warnings do not stop the way: the Fit tab's badge tells their number. */
export const hasErrors = ({ findings }: Model): boolean => findings !== null && findings.errors > 0;

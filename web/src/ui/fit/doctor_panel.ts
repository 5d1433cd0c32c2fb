import { adviceFor, wordsOf } from '../../net/problem.ts';
import type { Finding, FitReport, Model, Severity } from '../../net/types.ts';
import { h, replace } from '../shared/dom.ts';
import { actionFor, type FindingAction } from './finding_actions.ts';
import { countWords, findingTitle, sentence, severities, severityCount, severityMeanings, textsOf } from '../shared/finding_words.ts';
import type { FitModel } from './fit_model.ts';
import { formatCount } from '../shared/format.ts';
import { icon } from '../shared/icons.ts';
import type { Studio } from '../shared/studio.ts';
import { language, measureName, serverWords, t } from '../../words/words.ts';

export interface DoctorOptions {
  /** Whether enough points are placed for the server to make proposals. */
  enoughPoints: () => boolean;
  onAction: (action: FindingAction, finding: Finding) => void;
}

/** The findings of the open head, worst first; a click on a finding shows its place. */
export class DoctorPanel {
  readonly element: HTMLElement;
  private readonly body = h('div', { class: 'doctor' });
  /** The severities whose group the user has opened (true) or closed (false). */
  private readonly open = new Map<Severity, boolean>();
  private rows: { finding: Finding; element: HTMLElement; button: HTMLButtonElement }[] = [];

  constructor(
    private readonly studio: Studio,
    private readonly fit: FitModel,
    private readonly options: DoctorOptions,
  ) {
    this.element = h('section', {}, h('header', { class: 'section-head' }, h('h2', {}, t('Fit doctor'))), this.body);
    fit.report.watch(() => this.draw());
    fit.chosen.watch(() => this.mark());
    let shown = '';
    studio.selected.watch((model) => {
      if (model?.id !== shown) this.open.clear();
      shown = model?.id ?? '';
      this.draw();
    });
  }

  draw(): void {
    const state = this.fit.report.value;
    const model = this.studio.selected.value;
    this.rows = [];
    if (state.kind === 'ready' && model) return this.drawReport(state.report, model);
    if (state.kind === 'failed') {
      const advice = adviceFor(state.problem);
      replace(
        this.body,
        h(
          'p',
          { class: 'notice error', role: 'alert' },
          icon('warning', 16),
          h('span', {}, wordsOf(state.problem), advice ? ` ${advice}` : ''),
        ),
      );
      return;
    }
    const words =
      model === null
        ? t('Choose a head to check it.')
        : state.kind === 'loading' || model.state === 'importing'
          ? t('Checking the head…')
          : model.state === 'failed'
            ? t('The file could not be read, so there is nothing to check.')
            : t('This head was imported by a version without the fit doctor. Parametrize it again to check it.');
    replace(this.body, h('p', { class: 'empty' }, words));
  }

  private drawReport(report: FitReport, model: Model): void {
    const whole = model.state === 'parametrized';
    const looked = whole
      ? t('Mesh, points, parts and weights were checked when the head was last parametrized.')
      : t('Only the mesh has been checked so far. Points, parts and weights follow when the head is parametrized.');
    if (report.findings.length === 0) {
      replace(
        this.body,
        h('p', { class: 'healthy' }, icon('check', 20), h('span', {}, h('strong', {}, t('Nothing found. ')), looked)),
        remarks(model),
      );
      return;
    }
    replace(
      this.body,
      h('p', { class: 'muted small' }, h('strong', {}, `${countWords(report.summary)}. `), looked),
      severities.map((severity) => {
        const findings = report.findings.filter((finding) => finding.severity === severity);
        if (findings.length === 0) return null;
        const worse = report.findings.length > findings.length && severity === 'note';
        const group = h(
          'details',
          { class: 'finding-group', open: this.open.get(severity) ?? !(worse && findings.length > 2) },
          h(
            'summary',
            {},
            icon('chevron', 14),
            h('span', { class: `lamp lamp-${severity}`, 'aria-hidden': 'true' }),
            h('h3', {}, severityCount(severity, findings.length)),
            h('span', { class: 'muted small grow' }, severityMeanings[severity]),
          ),
          h(
            'ul',
            { class: 'findings' },
            findings.map((finding) => this.row(finding)),
          ),
        );
        group.addEventListener('toggle', () => this.open.set(severity, group.open));
        return group;
      }),
      remarks(model),
    );
    this.mark();
  }

  private row(finding: Finding): HTMLElement {
    const { place, measured } = finding;
    const [words, remedy] = textsOf(finding);
    const placed =
      place.part !== null || place.points.length > 0 || place.vertices.count > 0 || place.position !== null;
    const action = actionFor(finding, this.options.enoughPoints());
    const button = h(
      'button',
      {
        type: 'button',
        class: 'finding-show',
        'aria-pressed': 'false',
        title: placed ? t('Show where') : null,
        on: { click: () => this.fit.choose(this.fit.chosen.value === finding ? null : finding) },
      },
      h('strong', {}, findingTitle(finding)),
      h('span', { class: 'finding-words' }, words),
    );
    const facts = [
      place.vertices.count > 0
        ? place.vertices.count === 1 ? t('1 vertex') : t('{count} vertices', { count: formatCount(place.vertices.count) })
        : '',
      measured ? t('{what}: {value}, a finding from {threshold}', { what: measureName(measured.what), value: figure(measured.value), threshold: figure(measured.threshold) }) : '',
    ].filter((text) => text !== '');
    const element = h(
      'li',
      { class: `finding ${finding.severity}`, 'data-code': finding.code },
      button,
      h('p', { class: 'remedy' }, icon('wrench', 15), h('span', {}, remedy)),
      facts.length > 0 ? h('p', { class: 'finding-facts small muted' }, facts.join(' · ')) : null,
      action
        ? h(
            'button',
            { type: 'button', class: 'small', on: { click: () => this.options.onAction(action, finding) } },
            action.label,
          )
        : null,
    );
    this.rows.push({ finding, element, button });
    return element;
  }

  private mark(): void {
    for (const { finding, element, button } of this.rows) {
      const on = this.fit.chosen.value === finding;
      element.classList.toggle('chosen', on);
      button.setAttribute('aria-pressed', String(on));
    }
  }
}

/** The warnings of the import and of the feature points. */
function remarks({ warnings = [] }: Model): HTMLElement | null {
  if (warnings.length === 0) return null;
  return h(
    'div',
    { class: 'remarks small' },
    h('h3', {}, t('Notes on the file and its points')),
    h(
      'ul',
      {},
      warnings.map((text) => h('li', {}, sentence(serverWords(text)))),
    ),
  );
}

const figure = (value: number): string => value.toLocaleString(language, { maximumSignificantDigits: 3 });

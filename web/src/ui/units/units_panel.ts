import { lengthUnits, lengthWords, unitDivisor, unitLines, type UnitLine } from '../../face/unit_measures.ts';
import { UnitLines, type LabelledLine } from '../../view/unit_lines.ts';
import type { Parametrizer } from '../points/parametrizer.ts';
import type { PointsModel } from '../points/points_model.ts';
import { h, redraw, replace } from '../shared/dom.ts';
import { formatNumber } from '../shared/format.ts';
import { icon } from '../shared/icons.ts';
import { capital } from '../shared/names.ts';
import type { Studio } from '../shared/studio.ts';
import type { SceneView } from '../stage/scene.ts';
import { nameOf, t } from '../../words/words.ts';

const sides: Record<UnitLine['unit'], LabelledLine['side']> = {
  IRISD: 'beside',
  ES: 'above',
  ENS: 'beside',
  MNS: 'beside',
  MW: 'below',
};

/** The units of the shown face (FAPU): as lines on the face, with their values, which can be given by hand. */
export class UnitsPanel {
  readonly element: HTMLElement;
  private readonly body = h('div', { class: 'units-body' });
  private on = false;
  /** Units that are measured again, since the shown face was made. */
  private readonly released = new Set<string>();

  constructor(
    private readonly scene: SceneView,
    private readonly points: PointsModel,
    private readonly studio: Studio,
    private readonly parametrizer: Parametrizer,
  ) {
    const box = h('input', { type: 'checkbox', role: 'switch', id: 'units-view' });
    box.addEventListener('change', () => {
      this.on = box.checked;
      this.drawLines();
      this.draw();
    });
    this.element = h(
      'section',
      { class: 'units' },
      h(
        'label',
        { class: 'switch-row', for: 'units-view' },
        h(
          'span',
          { class: 'grow' },
          h('strong', {}, t('Units')),
          h('small', { class: 'muted' }, t('The lengths (FAPU) by which this face scales all motion.')),
        ),
        box,
      ),
      this.body,
    );
    scene.performer.watch(() => {
      this.released.clear();
      this.drawLines();
      this.draw();
    });
    points.changed.watch(() => this.draw());
    points.busy.watch(() => this.draw());
    studio.activities.watch(() => this.draw());
  }

  private drawLines(): void {
    const { rig, face } = this.scene;
    if (!this.on || !rig || !face) {
      this.scene.units = null;
      return;
    }
    const labelled = new Set<string>();
    this.scene.units = new UnitLines(
      unitLines(rig).map(({ unit, length, from, to }): LabelledLine => {
        const name = labelled.has(unit) ? '' : unit;
        labelled.add(unit);
        return { from, to, name, value: formatNumber(length, 4), side: sides[unit] };
      }),
    );
  }

  private draw(): void {
    this.element.hidden = this.scene.rig === null;
    this.body.hidden = !this.on;
    if (!this.on) return;
    const busy = this.points.busy.value || this.studio.activities.value.size > 0;
    redraw(this.body, () =>
      replace(
        this.body,
        lengthUnits.map((unit) => this.row(unit.name, unit.meaning, busy)),
        this.pending()
          ? h(
              'div',
              { class: 'row units-note', role: 'status' },
              h('span', { class: 'grow small' }, t('The face moves by the old units until it is parametrized again.')),
              h(
                'button',
                {
                  type: 'button',
                  class: 'primary',
                  disabled: busy,
                  'data-focus': 'units-go',
                  on: { click: () => void this.parametrizer.run() },
                },
                t('Parametrize again'),
              ),
            )
          : null,
      ),
    );
  }

  private row(unit: UnitLine['unit'], meaning: string, busy: boolean): HTMLElement {
    const shown = this.scene.rig?.fapu[unit] ?? null;
    const byHand = this.points.fapu[unit];
    const value = byHand ?? (shown === null ? null : shown * unitDivisor);
    const input = h('input', {
      type: 'number',
      step: 'any',
      min: 0,
      id: `unit-${unit}`,
      value: value === null ? '' : lengthWords(value),
      placeholder: t('not measured'),
      disabled: busy,
      'data-focus': `unit-${unit}`,
      on: { change: () => this.set(unit, input) },
    });
    return h(
      'div',
      { class: 'unit-row' },
      h('label', { for: `unit-${unit}`, title: capital(nameOf(meaning)) }, h('strong', {}, unit), h('small', { class: 'muted' }, shortMeanings[unit])),
      input,
      byHand === undefined
        ? h('small', { class: 'muted unit-origin' }, t('measured'))
        : h(
            'button',
            {
              type: 'button',
              class: 'quiet small unit-origin',
              disabled: busy,
              title: t('Measure {unit} between its points again', { unit }),
              'data-focus': `reset-${unit}`,
              on: { click: () => void this.release(unit) },
            },
            icon('reset', 14),
            t('by hand'),
          ),
    );
  }

  private set(unit: UnitLine['unit'], input: HTMLInputElement): void {
    const length = Number(input.value);
    if (input.value.trim() === '' || !(length > 0)) {
      this.studio.toasts.say(t('{unit} is a length: a number above zero, in the units of the model.', { unit }));
      this.draw();
      return;
    }
    void this.points.setUnit(unit, length);
  }

  private async release(unit: UnitLine['unit']): Promise<void> {
    if (!(await this.points.setUnit(unit, null))) return;
    this.released.add(unit);
    this.draw();
  }

  /** Whether the stored units differ from those of the shown face. */
  private pending(): boolean {
    const { rig } = this.scene;
    if (!rig) return false;
    return lengthUnits.some(({ name }) => {
      const byHand = this.points.fapu[name];
      if (byHand === undefined) return this.released.has(name);
      const shown = rig.fapu[name];
      return shown === null || Math.abs(shown * unitDivisor - byHand) > 1e-5 * byHand;
    });
  }
}

const shortMeanings: Record<UnitLine['unit'], string> = {
  IRISD: t('iris, or lid to lid'),
  ES: t('eye to eye'),
  ENS: t('eyes to nose'),
  MNS: t('nose to mouth'),
  MW: t('mouth width'),
};

import type { Direction, FrameWish, LengthUnit, Model, ModelFrame } from '../../net/types.ts';
import { h, replace } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import { canIdle, setIdle } from '../shared/idle.ts';
import type { Studio } from '../shared/studio.ts';
import { language, serverWords, t } from '../../words/words.ts';

const units: readonly { unit: LengthUnit; name: string }[] = [
  { unit: 'm', name: t('metres') },
  { unit: 'dm', name: t('decimetres') },
  { unit: 'cm', name: t('centimetres') },
  { unit: 'mm', name: t('millimetres') },
  { unit: 'in', name: t('inches') },
];
const directions: readonly Direction[] = ['+X', '-X', '+Y', '-Y', '+Z', '-Z'];

/** Unit and axes of the open head: the server's guess with its reasons, and a form to correct it. */
export class FramePanel {
  readonly element: HTMLElement;
  private readonly said = h('div', { class: 'frame-said', 'aria-live': 'polite' });
  private readonly unit = choice(
    'frame-unit',
    t('Unit'),
    units.map(({ unit, name }) => [unit, `${unit} (${name})`]),
  );
  private readonly up = choice(
    'frame-up',
    t('Top of the head'),
    directions.map((one) => [one, one]),
  );
  private readonly front = choice(
    'frame-front',
    t('Front of the face'),
    directions.map((one) => [one, one]),
  );
  private readonly apply = h('button', { type: 'submit', class: 'primary small' }, t('Apply'));
  private readonly guess = h(
    'button',
    {
      type: 'button',
      class: 'quiet small',
      on: { click: () => void this.send({ unit: null, up: null, front: null }) },
    },
    t('Guess again'),
  );
  private drawn = '';

  constructor(private readonly studio: Studio) {
    const form = h(
      'form',
      { class: 'frame-form' },
      this.unit.element,
      this.up.element,
      this.front.element,
      h('div', { class: 'row end' }, this.guess, this.apply),
    );
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      void this.send(this.wish());
    });
    canIdle(this.apply, studio.toasts);
    form.addEventListener('change', () => this.check());
    this.element = h(
      'section',
      { class: 'frame-section' },
      h('header', { class: 'section-head' }, h('h2', {}, t('Unit and axes'))),
      this.said,
      h(
        'p',
        { class: 'muted small' },
        t('Directions are axes of the file. A change of axes rotates the head on the stage.'),
      ),
      form,
    );
    studio.selected.watch((model) => this.draw(model));
    studio.activities.watch(() => this.check());
  }

  /** Opens the form, scrolls to it and focuses it. */
  reveal(): void {
    this.element.scrollIntoView({ block: 'center' });
    this.up.select.focus({ preventScroll: true });
  }

  private draw(model: Model | null): void {
    const frame = model?.frame ?? null;
    this.element.hidden = frame === null;
    const reasons = frame?.reasons.map(serverWords) ?? [];
    const key = JSON.stringify([model?.id, frame, model?.bounds, reasons]);
    if (!model || !frame || key === this.drawn) return this.check();
    this.drawn = key;
    this.unit.select.value = frame.unit;
    this.up.select.value = frame.axes.up;
    this.front.select.value = frame.axes.front;
    this.guess.hidden = !frame.by_user.unit && !frame.by_user.axes;
    const size = sizeWords(model, frame);
    replace(
      this.said,
      h(
        'dl',
        { class: 'frame-facts' },
        h('dt', {}, t('One unit')),
        h('dd', {}, `1 ${frame.unit}`, origin(frame.by_user.unit, frame.sure.unit)),
        h('dt', {}, t('Axes')),
        h(
          'dd',
          {},
          t('{up} up, {front} to the front', { up: frame.axes.up, front: frame.axes.front }),
          origin(frame.by_user.axes, frame.sure.axes),
        ),
        size === '' ? null : [h('dt', {}, t('Resulting size')), h('dd', { class: 'number' }, size)],
      ),
      reasons.length > 0
        ? h(
            'details',
            { class: 'reasons', open: !frame.sure.unit || !frame.sure.axes },
            h('summary', { class: 'small' }, icon('chevron', 14), t('Why')),
            h(
              'ul',
              {},
              reasons.map((reason) => h('li', { class: 'small' }, reason)),
            ),
          )
        : null,
    );
    this.check();
  }

  /** The values of the form that differ from the set ones. An uncertain guess may be confirmed unchanged. */
  private wish(): FrameWish {
    const frame = this.studio.selected.value?.frame;
    if (!frame) return {};
    const { by_user: byUser, sure, axes } = frame;
    const unit = this.unit.select.value as LengthUnit;
    const up = this.up.select.value as Direction;
    const front = this.front.select.value as Direction;
    const unitIsNews = unit !== frame.unit || !(byUser.unit || sure.unit);
    const axesAreNews = up !== axes.up || front !== axes.front || !(byUser.axes || sure.axes);
    return { ...(unitIsNews ? { unit } : {}), ...(axesAreNews ? { up, front } : {}) };
  }

  private check(): void {
    const model = this.studio.selected.value;
    const busy = model === null || model.state === 'importing' || this.studio.activities.value.has(model.id);
    const axis = this.up.select.value.slice(1);
    const clash = this.front.select.value.endsWith(axis);
    for (const option of this.front.select.options) option.disabled = option.value.endsWith(axis);
    const nothing = Object.keys(this.wish()).length === 0;
    this.apply.disabled = busy;
    setIdle(
      this.apply,
      t('Use this unit and these axes'),
      clash
        ? { why: t('The top of the head and the front of the face need different axes.'), help: { label: t('Choose another front'), act: () => this.front.select.focus() } }
        : nothing
          ? { why: t('Nothing is changed yet.'), help: { label: t('Change the unit'), act: () => this.unit.select.focus() } }
          : null,
    );
    this.guess.disabled = busy;
    for (const { select } of [this.unit, this.up, this.front]) select.disabled = busy;
  }

  private async send(wish: FrameWish): Promise<void> {
    const model = this.studio.selected.value;
    if (model) await this.studio.setFrame(model, wish);
  }
}

function choice(
  id: string,
  label: string,
  values: readonly (readonly [string, string])[],
): { element: HTMLElement; select: HTMLSelectElement } {
  const select = h(
    'select',
    { id },
    values.map(([value, title]) => h('option', { value }, title)),
  );
  return {
    element: h('div', { class: 'frame-field' }, h('label', { for: id, class: 'muted small' }, label), select),
    select,
  };
}

function origin(byUser: boolean, sure: boolean): HTMLElement {
  const words = byUser ? t('yours') : sure ? t('guessed, certain') : t('guessed, uncertain');
  return h('span', { class: `tag ${byUser ? 'by-hand' : sure ? '' : 'unsure'}` }, words);
}

/** "24 × 31 × 26 cm": width, height and depth. */
function sizeWords(model: Model, frame: ModelFrame): string {
  if (!model.bounds) return '';
  const { min, max } = model.bounds;
  const metres = [0, 1, 2].map((axis) => (max[axis]! - min[axis]!) * frame.metres_per_unit);
  const [name, scale] = Math.max(...metres) < 1.5 ? (['cm', 100] as const) : (['m', 1] as const);
  return `${metres.map((value) => (value * scale).toLocaleString(language, { maximumSignificantDigits: 3 })).join(' × ')} ${name}`;
}

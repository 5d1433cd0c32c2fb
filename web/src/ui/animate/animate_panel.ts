import type { FaceFrame, Pose } from '@client/index.ts';
import { expressions, visemes } from '@protocol/generated/mpeg4.ts';
import { maxBlend } from '@protocol/face_frame.ts';
import {
  clearFrame,
  expressionIntensity,
  isNeutral,
  mirrorFrame,
  setExpression,
  setVisemes,
  shutEyes,
} from '../../face/frame.ts';
import { h, setText } from '../shared/dom.ts';
import { expressionFace } from './expression_face.ts';
import { FapSliders, fapsWithoutEffect } from './fap_sliders.ts';
import { icon } from '../shared/icons.ts';
import { canIdle, setIdle } from '../shared/idle.ts';
import { messageOf } from '../shared/message_of.ts';
import { capital } from '../shared/names.ts';
import { rove } from '../shared/roving.ts';
import { Slider } from '../shared/slider.ts';
import type { Toasts } from '../shared/toast.ts';
import { VisemeGrid } from './viseme_grid.ts';
import { visemeTitle } from './viseme_title.ts';
import { VisemePad } from './viseme_pad.ts';
import { nameOf, t } from '../../words/words.ts';

const idleNote = t('Adds blinks and glances to what you set, on this page only.');

export interface AnimatePanelOptions {
  frame: FaceFrame;
  toasts: Pick<Toasts, 'say'>;
  /** Called after a slider or button changed the frame. */
  onChange: () => void;
  /** Called when a slider of a FAP is used, with the mirror FAP that moves with it, or 0. */
  onFap: (fap: number, mirror: number) => void;
  /** Buttons that take the face on the stage out of the page. */
  exports: readonly HTMLElement[];
  /** What is seen on the face beside its picture: the controls of the influence view and of the units. */
  views: readonly HTMLElement[];
  /** Where the expressions of this head are its own. */
  ownExpressions: HTMLElement;
  /** Called when idle life is switched on or off. Fails if it cannot be played. */
  onIdle: (on: boolean) => Promise<void>;
  /** Called when the player chooses whether FAP 3 alone takes the lower lip along. */
  onJawTakesLip: (takes: boolean) => void;
}

/** How long a blink keeps the eyes closed, ms; the face eases to and from the closed pose. */
const blinkTime = 160;

/** The controls that set the frame: visemes, expressions and all low-level FAPs. */
export class AnimatePanel {
  readonly element: HTMLElement;
  private readonly grid: VisemeGrid;
  private readonly pad = new VisemePad((first, second, share) => this.blend(first, second, share));
  private readonly strength: Slider;
  private readonly second: HTMLSelectElement;
  private readonly feelings: { slider: Slider; row: HTMLElement; button: HTMLButtonElement }[] = [];
  private readonly faps: FapSliders;
  private readonly resetAll: HTMLButtonElement;
  private readonly idle = h('input', { type: 'checkbox', role: 'switch', id: 'idle-life' });
  private viseme = 0;
  private blinking = false;

  constructor(private readonly options: AnimatePanelOptions) {
    this.grid = new VisemeGrid({ onChoose: (viseme) => this.chooseViseme(viseme) });
    this.strength = new Slider({
      label: t('Strength'),
      note: '%',
      min: 0,
      max: 100,
      value: 100,
      onInput: () => this.applyViseme(),
    });
    this.second = h(
      'select',
      { id: 'second-viseme', on: { change: () => this.applyViseme() } },
      ...visemes.map((viseme, number) =>
        h('option', { value: number }, visemeTitle(viseme)),
      ),
    );
    this.faps = new FapSliders({
      frame: options.frame,
      onChange: () => this.changed(),
      onUse: options.onFap,
      onJawTakesLip: options.onJawTakesLip,
    });
    this.resetAll = h(
      'button',
      { type: 'button', class: 'quiet', on: { click: () => this.reset() } },
      icon('reset', 16),
      t('Neutral face'),
    );
    canIdle(this.resetAll, options.toasts);
    const act = (title: string, name: 'blink' | 'mirror', hint: string, action: () => void): HTMLElement =>
      h('button', { type: 'button', class: 'quiet', title: hint, on: { click: action } }, icon(name, 16), title);
    const take = h('div', { class: 'row wrap quick-acts', role: 'toolbar', 'aria-label': t('Save or share this face') }, ...options.exports);
    rove(take, 'button');
    const whole = h(
      'div',
      { class: 'row wrap quick-acts', role: 'toolbar', 'aria-label': t('Whole face') },
      act(t('Blink'), 'blink', t('Close the eyes for a moment'), () => this.blink()),
      act(t('Mirror'), 'mirror', t('Exchange left and right'), () => this.mirror()),
      h('span', { class: 'grow' }),
      this.resetAll,
    );
    rove(whole, 'button');
    this.element = h(
      'div',
      { class: 'panel animate' },
      whole,
      take,
      h(
        'section',
        {},
        h('header', { class: 'section-head' }, h('h2', {}, t('Visemes'))),
        this.grid.element,
        this.pad.element,
        h(
          'div',
          { class: 'blend' },
          this.strength.element,
          h('label', { for: 'second-viseme', class: 'field-row' }, h('span', {}, t('Blend with')), this.second),
        ),
      ),
      h(
        'section',
        {},
        h(
          'header',
          { class: 'section-head' },
          h('h2', {}, t('Expressions')),
          h('span', { class: 'muted small' }, t('two at a time')),
        ),
        h('div', { class: 'feelings' }, ...this.makeFeelings()),
        options.ownExpressions,
      ),
      h('section', {}, h('header', { class: 'section-head' }, h('h2', {}, t('Face parameters'))), this.faps.element),
      this.makeIdle(),
      ...options.views,
    );
    this.refresh();
  }

  /** Sets the face on the stage (any pose of it); null: none. */
  showFace(pose: Pose | null): void {
    if (pose) this.faps.hide(fapsWithoutEffect(pose));
  }

  /** Updates the controls after other code changed the frame. */
  refresh(): void {
    const { frame } = this.options;
    this.grid.show(frame.viseme.select1 === 0 && frame.viseme.blend === 0 ? 0 : frame.viseme.select1);
    this.pad.show(frame.viseme.select1, frame.viseme.select2, frame.viseme.blend === 0 && frame.viseme.select2 === 0 ? 1 : frame.viseme.blend / maxBlend);
    for (const [i, feeling] of this.feelings.entries()) {
      const intensity = expressionIntensity(frame, i + 1);
      // The frame has 64 steps, the slider 100: do not move a slider that already rounds to the step, during a drag.
      if (Math.round((feeling.slider.value / 100) * maxBlend) !== intensity)
        feeling.slider.set(Math.round((intensity / maxBlend) * 100));
      feeling.row.classList.toggle('on', intensity > 0);
      feeling.button.setAttribute('aria-pressed', String(intensity > 0));
    }
    this.faps.refresh();
    setIdle(this.resetAll, t('Neutral face'), isNeutral(frame) ? { why: t('All sliders are at neutral.'), help: { label: t('Show a smile'), act: () => this.smile() } } : null);
  }

  reset(): void {
    clearFrame(this.options.frame);
    this.viseme = 0;
    this.strength.set(100);
    this.second.value = '0';
    this.changed();
  }

  /** Switches idle life on, as the switch does. */
  enliven(): void {
    if (!this.idle.checked) this.idle.click();
  }

  private makeIdle(): HTMLElement {
    const box = this.idle;
    const note = h('small', { class: 'muted' }, idleNote);
    box.addEventListener('change', () => {
      setText(note, idleNote);
      this.options.onIdle(box.checked).catch((error: unknown) => {
        box.checked = false;
        setText(note, t('Could not be loaded: {error}', { error: messageOf(error) }));
      });
    });
    return h(
      'label',
      { class: 'switch-row', for: 'idle-life' },
      h(
        'span',
        { class: 'grow' },
        h('strong', {}, t('Idle life')),
        note,
      ),
      box,
    );
  }

  private blink(): void {
    if (this.blinking) return;
    this.blinking = true;
    const open = shutEyes(this.options.frame);
    this.changed();
    setTimeout(() => {
      this.blinking = false;
      open();
      this.changed();
    }, blinkTime);
  }

  private smile(): void {
    setExpression(this.options.frame, 1, maxBlend);
    this.changed();
  }

  private mirror(): void {
    mirrorFrame(this.options.frame);
    this.changed();
  }

  private chooseViseme(viseme: number): void {
    this.viseme = this.viseme === viseme ? 0 : viseme;
    this.applyViseme();
  }

  private blend(first: number, second: number, share: number): void {
    this.viseme = first;
    this.strength.set(Math.round(share * 100));
    this.second.value = String(second);
    this.applyViseme();
  }

  private applyViseme(): void {
    setVisemes(this.options.frame, this.viseme, Number(this.second.value), this.strength.value / 100);
    this.changed();
  }

  private makeFeelings(): HTMLElement[] {
    return expressions.slice(1).map((expression, i) => {
      const number = i + 1;
      const slider = new Slider({
        label: nameOf(capital(expression.name)),
        note: '%',
        title: nameOf(expression.description),
        min: 0,
        max: 100,
        onInput: (value) => this.setFeeling(number, value),
      });
      const button = h(
        'button',
        {
          type: 'button',
          class: 'feeling-button',
          'data-expression': number,
          'aria-pressed': 'false',
          'aria-label': t('{name} on or off', { name: nameOf(capital(expression.name)) }),
          title: nameOf(expression.description),
          on: { click: () => this.setFeeling(number, expressionIntensity(this.options.frame, number) > 0 ? 0 : 100) },
        },
        expressionFace(number),
      );
      const row = h('div', { class: 'feeling-row' }, button, slider.element);
      this.feelings.push({ slider, row, button });
      return row;
    });
  }

  private setFeeling(expression: number, percent: number): void {
    setExpression(this.options.frame, expression, Math.round((percent / 100) * maxBlend));
    this.changed();
  }

  private changed(): void {
    this.refresh();
    this.options.onChange();
  }
}

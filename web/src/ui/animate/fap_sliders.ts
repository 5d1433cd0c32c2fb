import type { FaceFrame, Pose } from '@client/index.ts';
import { fapGroups, faps, type Fap } from '@protocol/generated/mpeg4.ts';
import { fapValue, setFap } from '../../face/frame.ts';
import { h, setText } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import { fapGroupTitles, fapTitle } from '../shared/names.ts';
import { Slider } from '../shared/slider.ts';
import { language, t } from '../../words/words.ts';

export interface FapSlidersOptions {
  frame: FaceFrame;
  onChange: () => void;
  /** Called when a slider is used, with the FAP and the mirror FAP that moves with it, or 0. */
  onUse: (fap: number, mirror: number) => void;
  /** Called when the player chooses whether FAP 3 alone takes the lower lip along. */
  onJawTakesLip: (takes: boolean) => void;
}

/** FAPs without effect on this face, because it has no iris or no tongue; their sliders are hidden. */
export function fapsWithoutEffect(pose: Pose): ReadonlySet<number> {
  const without = new Set<number>();
  if (pose.irises[3] === 0) without.add(29);
  if (pose.irises[9] === 0) without.add(30);
  if (pose.tongue[9] === 0) without.add(47);
  return without;
}

/** Whether a FAP is one of those that these words look for: by its number, its name in the standard or its title. */
export function fapMatches(fap: Fap, words: string): boolean {
  const wanted = words.trim().toLowerCase();
  if (/^(fap ?)?\d+$/.test(wanted)) return fap.number === Number(wanted.replace(/\D/g, ''));
  const text = `${fap.name} ${fapTitle(fap.name, fap.group)}`.toLowerCase();
  return wanted.split(/\s+/).every((word) => text.includes(word));
}

interface Group {
  list: readonly Fap[];
  /** The group with the button that resets it: a control inside of a summary cannot be reached by every reader. */
  seat: HTMLElement;
  element: HTMLDetailsElement;
  /** Makes its sliders, once. */
  fill: () => void;
  /** Whether the search has opened it, and not the user. */
  opened: boolean;
}

/** Sliders of the low-level FAPs in the standard's groups, collapsed at first. */
export class FapSliders {
  readonly element = h('div', { class: 'fap-groups' });
  private readonly sliders = new Map<number, Slider>();
  private readonly counts = new Map<number, HTMLElement>();
  private readonly resets = new Map<number, HTMLButtonElement>();
  private readonly groups: Group[] = [];
  private readonly nothing = h('p', { class: 'empty', hidden: true }, t('No face parameter matches.'));
  private words = '';
  private both = true;
  private without: ReadonlySet<number> = new Set();

  constructor(private readonly options: FapSlidersOptions) {
    const search = h('input', {
      type: 'search',
      placeholder: t('Search: jaw, 31…'),
      'aria-label': t('Search face parameters'),
      on: { input: () => this.search(search.value) },
    });
    this.element.append(h('div', { class: 'search' }, icon('search', 16), search));
    const both = h('input', { type: 'checkbox', checked: true, on: { change: () => (this.both = both.checked) } });
    this.element.append(h('label', { class: 'check' }, both, icon('link', 16), t('Move left and right together')));
    const lip = h('input', {
      type: 'checkbox',
      id: 'jaw-takes-lip',
      on: { change: () => options.onJawTakesLip(lip.checked) },
    });
    const hint = t('FAP 3 alone does not part the lips in the standard. Sliders of the lip itself win in both cases.');
    this.element.append(h('label', { class: 'check', title: hint }, lip, t('The jaw takes the lower lip along')));
    for (const group of fapGroups)
      if (group.number > 1) this.element.append(this.makeGroup(group.number, faps.slice(group.first - 1, group.last)));
    this.element.append(this.nothing);
  }

  /** Hides the sliders of these FAPs and shows all others. */
  hide(without: ReadonlySet<number>): void {
    this.without = without;
    this.draw();
  }

  /** Opens the groups with a FAP that matches, and shows only the matching ones; no words: everything as it was. */
  search(words: string): void {
    this.words = words;
    const any = words.trim() !== '';
    for (const group of this.groups) {
      const matches = any && group.list.some((fap) => this.isShown(fap));
      if (matches) group.fill();
      if (matches && !group.element.open) group.opened = group.element.open = true;
      else if (!any && group.opened) group.opened = group.element.open = false;
    }
    this.draw();
  }

  private isShown(fap: Fap): boolean {
    return !this.without.has(fap.number) && (this.words.trim() === '' || fapMatches(fap, this.words));
  }

  private draw(): void {
    for (const [number, slider] of this.sliders) slider.element.hidden = !this.isShown(faps[number - 1]!);
    for (const { list, seat } of this.groups) seat.hidden = !list.some((fap) => this.isShown(fap));
    this.nothing.hidden = this.groups.some(({ seat }) => !seat.hidden);
  }

  /** Sets the sliders to the frame's values. */
  refresh(): void {
    for (const [number, slider] of this.sliders) slider.set(fapValue(this.options.frame, number));
    for (const [group, count] of this.counts) {
      const moved = faps.filter((fap) => fap.group === group && this.options.frame.levels[fap.number] !== 0).length;
      setText(count, moved === 0 ? '' : t('{moved} moved', { moved }));
      this.resets.get(group)!.hidden = moved === 0;
    }
  }

  private makeGroup(group: number, list: readonly Fap[]): HTMLElement {
    const count = h('span', { class: 'badge quiet-badge' });
    this.counts.set(group, count);
    const title = fapGroupTitles[group] ?? t('Group {group}', { group });
    const reset = h(
      'button',
      {
        type: 'button',
        class: 'quiet square small',
        'aria-label': t('Reset {title}', { title }),
        title: t('Reset {title}', { title }),
        on: {
          click: () => {
            for (const fap of list) this.options.frame.levels[fap.number] = 0;
            this.changed();
          },
        },
      },
      icon('reset', 15),
    );
    this.resets.set(group, reset);
    const body = h('div', { class: 'fap-list' });
    const details = h(
      'details',
      { class: 'fap-group', 'data-group': group },
      h(
        'summary',
        {},
        icon('chevron', 14),
        h('span', { class: 'grow' }, title),
        count,
        h('span', { class: 'muted small' }, String(list.length)),
      ),
      body,
    );
    const seat = h('div', { class: 'fap-seat' }, details, reset);
    // Sliders are created when a group is first opened: creating all 66 at once is slow on a phone.
    const fill = (): void => {
      if (body.childElementCount > 0) return;
      for (const fap of list) body.append(this.makeSlider(fap).element);
      this.draw();
      this.refresh();
    };
    details.addEventListener('toggle', () => details.open && fill());
    this.groups.push({ list, seat, element: details, fill, opened: false });
    return seat;
  }

  private makeSlider(fap: Fap): Slider {
    const label = fapTitle(fap.name, fap.group);
    // The standard's descriptions are in English only.
    const description = language === 'en' ? fap.description : label;
    const slider = new Slider({
      label,
      note: t('FAP {number}', { number: fap.number }),
      title: t('{description}. {name}, unit {unit}', { description, name: fap.name, unit: fap.unit ?? '' }),
      min: fap.usualMin,
      max: fap.usualMax,
      onInput: (value) => {
        const mirror = setFap(this.options.frame, fap.number, value, this.both);
        this.changed();
        this.options.onUse(fap.number, mirror);
      },
    });
    this.sliders.set(fap.number, slider);
    return slider;
  }

  private changed(): void {
    this.refresh();
    this.options.onChange();
  }
}

import { headFileEndings } from '../../net/head_files.ts';
import { formatList } from '../../net/model_formats.ts';
import { adviceFor, titleOf, wordsOf } from '../../net/problem.ts';
import type { Model } from '../../net/types.ts';
import { ask } from '../shared/dialog.ts';
import { h, keepChildren, replace } from '../shared/dom.ts';
import { formatPercent } from '../shared/format.ts';
import { findingBadge } from '../shared/finding_badge.ts';
import { listed, manyHeads, searchedHeads } from './head_order.ts';
import { headSize } from './head_size.ts';
import { stateInWords } from './head_state.ts';
import { icon } from '../shared/icons.ts';
import { progressBar } from '../shared/progress_bar.ts';
import { rem } from '../shared/rem.ts';
import { rove } from '../shared/roving.ts';
import type { Activity, Studio } from '../shared/studio.ts';
import { serverWords, t } from '../../words/words.ts';

/** The list of heads: upload, choose, rename, delete. */
export class Shelf {
  readonly element: HTMLElement;
  private readonly list = h('ul', { class: 'heads', 'aria-label': t('Heads') });
  private readonly input = h('input', {
    type: 'file',
    accept: headFileEndings,
    multiple: true,
    class: 'visually-hidden',
    id: 'file',
    tabindex: -1,
    'aria-label': t('Model files'),
  });

  private readonly words = h('input', {
    type: 'search',
    placeholder: t('Search heads'),
    'aria-label': t('Search heads'),
    on: { input: () => this.draw() },
  });
  private readonly search = h('div', { class: 'search', hidden: true }, icon('search', 16), this.words);

  private readonly low = matchMedia(`(max-height: ${rem(820)})`);

  /** Opens the chooser of model files. */
  readonly choose = (): void => this.input.click();
  /** Thumbnails as data URLs, by model id. */
  readonly thumbnails = new Map<string, string>();

  constructor(private readonly studio: Studio) {
    this.input.addEventListener('change', () => {
      const files = [...(this.input.files ?? [])].map((file) => ({ path: file.name, file }));
      void studio.upload(files);
      this.input.value = '';
    });
    this.element = h(
      'div',
      { class: 'panel shelf-panel' },
      h(
        'header',
        { class: 'section-head' },
        h('h2', {}, t('Heads')),
        this.addButton('wide-only'),
      ),
      this.search,
      this.list,
      h(
        'button',
        { type: 'button', class: 'drop', on: { click: this.choose } },
        icon('upload', 22),
        h('span', {}, h('strong', {}, t('Choose a head')), h('span', { class: 'drop-word' }, t(' or drop it here'))),
        h('small', {}, formatList),
      ),
      this.input,
    );
    rove(this.list, '[data-model] button');
    const draw = (): void => this.draw();
    studio.models.watch(draw);
    studio.selected.watch(draw);
    let seen: string | undefined;
    studio.selected.watch((model) => {
      if (model?.id === seen) return;
      seen = model?.id;
      this.reveal('.selected');
    });
    studio.tab.watch((tab) => {
      if (tab === 'heads') this.reveal('.selected');
    });
    studio.activities.watch(draw);
    studio.shelf.watch(draw);
    this.low.addEventListener('change', draw);
    // The list gets lower when what stands below it grows.
    new ResizeObserver(() => {
      if (isPartlySeen(this.list.querySelector('.selected'), this.list)) this.reveal('.selected');
    }).observe(this.list);
  }

  /** A narrow page has it in its bar, since the shelf is one of the tabs there: see layout.css. */
  addButton(where: 'wide-only' | 'narrow-only'): HTMLElement {
    return h(
      'button',
      {
        type: 'button',
        class: `quiet square ${where}`,
        'aria-label': t('Upload a head'),
        title: t('Upload a head'),
        on: { click: this.choose },
      },
      icon('plus'),
    );
  }

  /** Scrolls to an item, once the list is laid out. */
  private reveal(item: string): void {
    requestAnimationFrame(() => this.list.querySelector(item)?.scrollIntoView({ block: 'nearest' }));
  }

  /** Where the open head stood in the list when it was last drawn. */
  private place = -1;
  private uploads = 0;

  /** Keeps in sight what the list moves: an upload stands at its head, and a head that is new gets its place by the server's order. */
  private followMoves(heads: readonly Model[]): void {
    const { selected, activities } = this.studio;
    const place = heads.findIndex(({ id }) => id === selected.value?.id);
    const uploads = [...activities.value.keys()].filter(isUpload).length;
    if (uploads > this.uploads) this.reveal('.uploading');
    else if (place !== this.place && isSeen(this.list.querySelector('.selected'))) this.reveal('.selected');
    this.place = place;
    this.uploads = uploads;
  }

  /** The heads whose items are seen, from the top. */
  seen(): Model[] {
    const ids = [...this.list.querySelectorAll('[data-model]')].filter(isSeen).map((item) => item.getAttribute('data-model'));
    return this.studio.models.value.filter(({ id }) => ids.includes(id));
  }

  draw(): void {
    const { studio } = this;
    const state = studio.shelf.value;
    const focused = document.activeElement?.closest('[data-model]')?.getAttribute('data-model');
    if (state.kind === 'loading') {
      replace(this.list, ...[0, 1, 2].map(() => h('li', { class: 'head skeleton', 'aria-hidden': 'true' })));
      return;
    }
    if (state.kind === 'failed') {
      const advice = adviceFor(state.problem);
      replace(
        this.list,
        h(
          'li',
          { class: 'notice error' },
          icon('warning'),
          h(
            'div',
            { role: 'alert' },
            h('strong', {}, titleOf(state.problem)),
            advice ? h('p', {}, advice) : null,
            h('button', { type: 'button', on: { click: () => void studio.start() } }, t('Try again')),
          ),
        ),
      );
      return;
    }
    const items: HTMLElement[] = [];
    for (const [key, activity] of studio.activities.value)
      if (isUpload(key)) items.push(this.uploadItem(activity));
    this.search.hidden = studio.models.value.length < searchedHeads;
    this.element.classList.toggle('many', studio.models.value.length >= manyHeads(this.low.matches));
    const heads = listed(studio.models.value, this.search.hidden ? '' : this.words.value);
    for (const model of heads) items.push(this.keptItem(model, studio.activities.value.get(model.id)));
    if (items.length === 0) items.push(h('li', { class: 'empty' }, studio.models.value.length === 0 ? t('No heads yet.') : t('No head of this name.')));
    this.followMoves(heads);
    keepChildren(this.list, items);
    if (focused && !this.list.contains(document.activeElement)) this.list.querySelector<HTMLElement>(`[data-model="${CSS.escape(focused)}"] .open`)?.focus();
  }

  /** Items by head, with what they show: progress is drawn many times a second, in a list that may have a thousand of them. */
  private items = new WeakMap<Model, { shows: readonly unknown[]; element: HTMLElement }>();

  private keptItem(model: Model, activity: Activity | undefined): HTMLElement {
    const shows = [activity, this.studio.selected.value?.id === model.id, this.thumbnails.get(model.id)];
    const kept = this.items.get(model);
    // The words of a fault may have come in another language meanwhile.
    if (kept && model.state !== 'failed' && shows.every((one, i) => one === kept.shows[i])) return kept.element;
    const element = this.item(model, activity);
    this.items.set(model, { shows, element });
    return element;
  }

  private item(model: Model, activity: Activity | undefined): HTMLElement {
    const selected = this.studio.selected.value?.id === model.id;
    const picture = this.thumbnails.get(model.id);
    const facts = headSize(model);
    return h(
      'li',
      { class: `head${selected ? ' selected' : ''}`, 'data-model': model.id },
      h(
        'button',
        {
          type: 'button',
          class: 'open',
          'aria-current': selected ? 'true' : null,
          on: { click: () => this.studio.select(model.id) },
        },
        h(
          'span',
          { class: 'thumb-seat' },
          h(
            'span',
            { class: 'thumb' },
            picture ? h('img', { src: picture, alt: '' }) : icon('head', 24),
          ),
          activity ? null : findingBadge(model.findings),
        ),
        h(
          'span',
          { class: 'head-text' },
          h('strong', { dir: 'auto', title: model.name }, model.name || t('Unnamed')),
          activity
            ? h('span', { class: 'muted small' }, activity.title)
            : h(
                'span',
                { class: 'muted small head-about' },
                h('span', { class: `state state-${model.state}` }, stateInWords(model)),
                facts ? [' ', h('span', { class: 'head-facts' }, facts)] : null,
              ),
        ),
      ),
      h(
        'div',
        { class: 'head-actions' },
        h(
          'button',
          {
            type: 'button',
            class: 'quiet square small',
            'aria-label': t('Rename {name}', { name: model.name }),
            title: t('Rename'),
            on: { click: () => void this.rename(model) },
          },
          icon('edit', 16),
        ),
        h(
          'button',
          {
            type: 'button',
            class: 'quiet square small',
            'aria-label': t('Delete {name}', { name: model.name }),
            title: t('Delete'),
            on: { click: () => void this.remove(model) },
          },
          icon('trash', 16),
        ),
      ),
      activity ? progressBar(activity) : null,
      selected && model.state === 'failed' && model.problem
        ? h('p', { class: 'head-problem' }, [serverWords(model.problem.pointer ?? ''), wordsOf(model.problem)].filter(Boolean).join(' '))
        : null,
    );
  }

  private uploadItem(activity: Activity): HTMLElement {
    return h(
      'li',
      { class: 'head uploading' },
      h(
        'div',
        { class: 'open' },
        h('span', { class: 'thumb' }, icon('upload', 22)),
        h(
          'span',
          { class: 'head-text' },
          h('strong', {}, activity.title),
          activity.progress === null ? null : h('span', { class: 'muted small' }, formatPercent(activity.progress)),
        ),
      ),
      activity.cancel
        ? h(
            'button',
            {
              type: 'button',
              class: 'quiet square small',
              'aria-label': t('Cancel upload'),
              on: { click: activity.cancel },
            },
            icon('close', 16),
          )
        : null,
      progressBar(activity),
    );
  }

  private async rename(model: Model): Promise<void> {
    const name = await ask({ title: t('Rename head'), accept: t('Rename'), value: model.name });
    if (name !== null && name !== '' && name !== model.name) await this.studio.rename(model, name);
  }

  private async remove(model: Model): Promise<void> {
    const yes = await ask({
      title: t('Delete {name}?', { name: model.name }),
      text: t('Its feature points and its face package are deleted too. This cannot be undone.'),
      accept: t('Delete'),
      danger: true,
    });
    if (yes !== null) await this.studio.remove(model);
  }
}

/** Whether an activity is that of a file that is being sent. */
const isUpload = (key: string): boolean => key.startsWith('upload-');

/** Whether some of an item is within the part of its list that is shown. */
function isPartlySeen(item: Element | null, list: Element): boolean {
  if (!item) return false;
  const [own, shown] = [item.getBoundingClientRect(), list.getBoundingClientRect()];
  return own.top < shown.bottom && own.bottom > shown.top;
}

/** Whether an item of the list is within the part of it that is shown. */
function isSeen(item: Element | null): boolean {
  if (!item) return false;
  const { top, bottom, left } = item.getBoundingClientRect();
  const middle = (top + bottom) / 2;
  return bottom > top && item.contains(document.elementFromPoint(left + 20, middle));
}

import { titleOf } from '../../net/problem.ts';
import type { Player } from '@client/index.ts';
import type { StreamInfo } from '../../net/types.ts';
import { ask } from '../shared/dialog.ts';
import { h, keepChildren, replace, setOptions, setText } from '../shared/dom.ts';
import { formatBytes, formatCount } from '../shared/format.ts';
import { icon } from '../shared/icons.ts';
import { type LiveModel, streamOptions } from './live_model.ts';
import type { LiveSound } from './live_sound.ts';
import { progressBar } from '../shared/progress_bar.ts';
import { rove } from '../shared/roving.ts';
import { PhoneDialog } from './phone_dialog.ts';
import type { Signal } from '../shared/signal.ts';
import { askForStream } from './stream_dialog.ts';
import { StreamFacts } from './stream_facts.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

const stateWords = {
  off: t('Not connected'),
  connecting: t('Connecting'),
  open: t('Live'),
  waiting: t('Connecting again'),
  ended: t('Ended'),
} as const;

/** Larger differences between stream and playhead, ms, are not a delay: the player never lags that far. */
const longestDelay = 2000;

/** The network measurements that explain the delay. */
function networkWords({ clock, jitter, starved }: Player['stats']): string {
  if (clock === null || Number.isNaN(clock.uncertainty)) return '';
  const words = [
    t('Round trip {number} ms', { number: formatCount(Math.round(clock.roundTrip)) }),
    t('jitter {number} ms', { number: formatCount(Math.round(jitter)) }),
    t('clock within {number} ms', { number: formatCount(Math.round(Math.max(1, clock.uncertainty))) }),
  ];
  if (starved > 0) words.push(starved === 1 ? t('frames late once') : t('frames late {starved} times', { starved }));
  return words.join(' · ');
}

/** The list of streams, the state of the subscription, and publishing of the sliders. */
export class LivePanel {
  readonly element: HTMLElement;
  private readonly list = h('ul', { class: 'streams', 'aria-label': t('Streams') });
  private readonly status = h('div', { class: 'live-status' });
  private readonly figures: Record<'rate' | 'bytes' | 'latency' | 'frames', HTMLElement> = {
    rate: h('dd'),
    bytes: h('dd'),
    latency: h('dd'),
    frames: h('dd'),
  };
  private readonly network = h('p', { class: 'muted small', role: 'group', 'aria-label': t('Network') });
  private readonly publishBox = h('input', { type: 'checkbox', id: 'publish', role: 'switch' });
  private readonly target = h('select', { 'aria-label': t('Stream to send to') });
  private readonly publishNote = h('p', { class: 'muted small' });

  constructor(
    private readonly studio: Studio,
    private readonly live: LiveModel,
    sound: LiveSound,
    speech: HTMLElement,
    performance: HTMLElement,
    recordings: HTMLElement,
    /** What is shown over the picture. */
    over: { figures: Signal<boolean>; captions: Signal<boolean> },
  ) {
    const figure = (term: string, value: HTMLElement): HTMLElement => h('div', {}, h('dt', {}, term), value);
    this.publishBox.addEventListener('change', () => void this.togglePublish());
    this.target.addEventListener('change', () => {
      if (this.publishBox.checked) void this.togglePublish();
    });
    this.element = h(
      'div',
      { class: 'panel live' },
      h(
        'section',
        {},
        h('header', { class: 'section-head' }, h('h2', {}, t('Now'))),
        this.status,
        h(
          'dl',
          { class: 'figures-grid' },
          figure(t('Frames per second'), this.figures.rate),
          figure(t('Data rate'), this.figures.bytes),
          figure(t('Delay'), this.figures.latency),
          figure(t('Frame'), this.figures.frames),
        ),
        this.network,
        this.soundSwitch(sound),
        overSwitch('live-captions', t('Captions'), over.captions, t('What is said, where the server knows the words.')),
        overSwitch('live-overlay', t('Figures on the picture'), over.figures),
        new StreamFacts(live).element,
      ),
      h(
        'section',
        {},
        h(
          'header',
          { class: 'section-head' },
          h('h2', {}, t('Streams')),
          h(
            'button',
            {
              type: 'button',
              class: 'quiet square',
              'aria-label': t('New stream'),
              title: t('New stream'),
              on: { click: () => void this.create() },
            },
            icon('plus'),
          ),
        ),
        this.list,
      ),
      speech,
      recordings,
      performance,
      h(
        'section',
        {},
        h('header', { class: 'section-head' }, h('h2', {}, t('Send'))),
        h(
          'label',
          { class: 'switch-row', for: 'publish' },
          h(
            'span',
            { class: 'grow' },
            h('strong', {}, t('Publish my sliders')),
            h('small', { class: 'muted' }, t('All subscribers see your changes.')),
          ),
          this.publishBox,
        ),
        h('label', { class: 'field-row' }, h('span', {}, t('To')), this.target),
        this.publishNote,
      ),
    );
    rove(this.list, '[data-stream] button');
    live.streams.watch(() => this.drawList());
    live.following.watch(() => this.drawList());
    live.problem.watch(() => this.drawList());
    live.status.watch(() => this.drawStatus());
    live.sending.watch(() => this.drawSending());
    live.sendStatus.watch(() => this.drawSending());
  }

  /** Call twice a second. `player`: the player of the displayed face, or null. */
  refreshFigures(player: Player | null): void {
    const playhead = player?.playhead ?? NaN;
    const { stats } = this.live;
    const open = this.live.status.value.kind === 'open';
    setText(this.figures.rate, open ? formatCount(Math.round(stats.framesPerSecond)) : '–');
    setText(this.figures.bytes, open ? `${formatBytes(stats.bytesPerSecond)}/s` : '–');
    // While another source drives the face the playhead stands still, so its distance to the stream is meaningless.
    const delay = open && stats.mediaTime !== null && playhead > 0 ? Math.round(stats.mediaTime - playhead) : null;
    setText(this.figures.latency, delay !== null && delay < longestDelay ? t('{delay} ms', { delay: formatCount(Math.max(0, delay)) }) : '–');
    setText(this.figures.frames, open ? formatCount(stats.sequence) : '–');
    setText(this.network, open && delay !== null && player ? networkWords(player.stats) : '');
  }

  private soundSwitch({ fault }: LiveSound): HTMLElement {
    const { sound } = this.live;
    const box = h('input', { type: 'checkbox', id: 'live-sound', role: 'switch', on: { change: () => this.live.listen(box.checked) } });
    const note = h('small', { class: 'muted', role: 'status' });
    sound.watch((on) => (box.checked = on));
    fault.watch((why) => setText(note, why ?? ''));
    return h('label', { class: 'switch-row', for: 'live-sound' }, h('span', { class: 'grow' }, h('strong', {}, t('Sound')), note), box);
  }

  private drawStatus(): void {
    const status = this.live.status.value;
    replace(
      this.status,
      h(
        'div',
        { class: 'row' },
        h('span', { class: `lamp lamp-${status.kind}` }),
        h('strong', { class: 'grow' }, stateWords[status.kind], status.title ? `: ${status.title}` : ''),
        status.kind !== 'off'
          ? h('button', { type: 'button', class: 'small', on: { click: () => this.live.unsubscribe() } }, t('Disconnect'))
          : null,
      ),
      status.reason
        ? h(
            'p',
            { class: status.kind === 'ended' ? 'notice' : 'notice error', role: 'alert' },
            icon('warning', 16),
            status.reason,
          )
        : null,
    );
    this.drawList();
  }

  private drawList(): void {
    const problem = this.live.problem.value;
    const streams = this.live.streams.value;
    if (problem) {
      replace(
        this.list,
        h(
          'li',
          { class: 'notice error' },
          icon('warning', 16),
          h('div', { role: 'alert' }, h('strong', {}, titleOf(problem)), h('p', {}, t('Retrying every few seconds.'))),
        ),
      );
      return;
    }
    if (streams === null) {
      replace(this.list, h('li', {}, progressBar({ title: t('Loading streams'), progress: null })));
      return;
    }
    if (streams.length === 0) replace(this.list, h('li', { class: 'empty' }, t('No streams yet. Create one with the plus button.')));
    else keepChildren(this.list, this.keptItems(streams));
    const own = streamOptions(this.live.ownStreams);
    const wanted = this.live.sending.value ?? this.target.value;
    const chosen = own.some(([id]) => id === wanted) ? wanted : own[0]?.[0];
    setOptions(this.target, own.length === 0 ? [['', t('Create a new stream')]] : own, chosen ?? '');
  }

  /** The items of the streams, by id, with what they show: another frame of a stream alone must not interrupt a click on one of hundreds. */
  private items = new Map<string, { shows: string; element: HTMLElement }>();

  private keptItems(streams: readonly StreamInfo[]): HTMLElement[] {
    const before = this.items;
    this.items = new Map();
    for (const stream of streams) {
      const words = itemWords(stream);
      const on = this.live.following.value === stream.id;
      const shows = JSON.stringify([stream.title, stream.is_public, words, on]);
      const kept = before.get(stream.id);
      this.items.set(stream.id, kept?.shows === shows ? kept : { shows, element: this.item(stream, words, on) });
    }
    return [...this.items.values()].map(({ element }) => element);
  }

  private item(stream: StreamInfo, words: string, on: boolean): HTMLElement {
    return h(
      'li',
      { class: `stream${on ? ' selected' : ''}`, 'data-stream': stream.id },
      h(
        'div',
        { class: 'grow' },
        h('strong', {}, stream.title || stream.id),
        h('span', { class: 'muted small' }, words),
      ),
      h(
        'button',
        {
          type: 'button',
          class: 'quiet square small',
          'aria-label': t('Show {id} on a phone', { id: stream.title || stream.id }),
          title: t('On a phone'),
          on: { click: () => void new PhoneDialog(this.studio, stream).open() },
        },
        icon('phone', 16),
      ),
      stream.source === 'demo'
        ? null
        : h(
            'button',
            {
              type: 'button',
              class: 'quiet square small',
              'aria-label': t('Delete stream {id}', { id: stream.title || stream.id }),
              title: t('Delete'),
              on: { click: () => void this.remove(stream) },
            },
            icon('trash', 16),
          ),
      h(
        'button',
        {
          type: 'button',
          class: on ? 'small' : 'small primary',
          'aria-pressed': String(on),
          on: {
            click: () => (on ? this.live.unsubscribe() : this.live.subscribe(stream.id, stream.title || stream.id)),
          },
        },
        on ? t('Stop') : t('Watch'),
      ),
    );
  }

  private drawSending(): void {
    this.publishBox.checked = this.live.sending.value !== null;
    const { kind, reason } = this.live.sendStatus.value;
    const text =
      this.live.sending.value === null
        ? (reason ?? '')
        : kind === 'open'
          ? t('Publishing: move a slider in Animate.')
          : (reason ?? t('Connecting…'));
    setText(this.publishNote, text);
    this.publishNote.classList.toggle('error', kind === 'ended' || reason !== undefined);
  }

  private async create(): Promise<void> {
    const wish = await askForStream();
    if (wish?.title) await this.live.create(wish.title, wish.options);
  }

  private async remove(stream: StreamInfo): Promise<void> {
    const yes = await ask({
      title: t('Delete {id}?', { id: stream.title || stream.id }),
      text: t('All subscribers are disconnected.'),
      accept: t('Delete'),
      danger: true,
    });
    if (yes !== null) await this.live.remove(stream.id);
  }

  private async togglePublish(): Promise<void> {
    if (!this.publishBox.checked) return this.live.send(null);
    let target: string | null = this.target.value;
    if (target === '') target = await this.live.create(t('{name}, by hand', { name: this.studio.selected.value?.name ?? t('Head') }));
    this.live.send(target);
    this.drawSending();
  }
}

/** Who watches a stream, and what feeds it. */
function itemWords(stream: StreamInfo): string {
  const viewers = stream.subscribers === 1 ? t('1 subscriber') : t('{subscribers} subscribers', { subscribers: stream.subscribers });
  const senders = stream.playing
    ? t('plays {performance}', { performance: stream.playing.name || t('an unnamed performance') })
    : stream.source === 'demo'
      ? t('plays on the server')
      : stream.publishers === 0
        ? t('no publisher')
        : stream.publishers === 1 ? t('1 publisher') : t('{publishers} publishers', { publishers: stream.publishers });
  return `${viewers} · ${senders}`;
}

/** A switch for something that is shown over the picture. */
function overSwitch(id: string, title: string, shown: Signal<boolean>, note = ''): HTMLElement {
  const box = h('input', { type: 'checkbox', id, role: 'switch', on: { change: () => shown.set(box.checked) } });
  shown.watch((on) => (box.checked = on));
  const words = [h('strong', {}, title), note ? h('small', { class: 'muted' }, note) : null];
  return h('label', { class: 'switch-row', for: id }, h('span', { class: 'grow' }, ...words), box);
}

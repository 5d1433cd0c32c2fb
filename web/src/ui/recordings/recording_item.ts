import type { Recording, RecordingFormat } from '../../net/types.ts';
import { h, setText } from '../shared/dom.ts';
import { formatBytes, formatCount, formatTime } from '../shared/format.ts';
import { icon } from '../shared/icons.ts';
import { formatsOf } from '../shared/recording_formats.ts';
import { language, t } from '../../words/words.ts';

/** Why a recording ended, when no client stopped it. */
const endingWords: Record<string, string> = {
  'stream-ended': t('ended with its stream'),
  'max-duration': t('ended at the maximum duration'),
  'max-bytes': t('ended at the maximum size of a recording'),
  'max-total-bytes': t('ended at the maximum size of all recordings'),
  'max-token-bytes': t('ended at the maximum of what its token may store'),
  'disk-full': t('ended: the disk is full'),
  'server-stopped': t('ended with the server'),
  'server-killed': t('cut off when the server was killed'),
  damaged: t('its file is damaged'),
};

export interface RecordingActs {
  play: () => void;
  remove: () => void;
  download: (format: RecordingFormat) => void;
  look: (at: number) => void;
  toggle: () => void;
  /** Makes a button one that needs a parametrized head. */
  needsFace: (button: HTMLButtonElement) => void;
}

export interface RecordingSight {
  open: boolean;
  busy: boolean;
  /** The displayed moment of this recording, ms; null when the face does not show this recording. */
  at: number | null;
  /** Title of the stream, in a list of several streams; else null. */
  stream: string | null;
}

/** The facts of a recording in one line. */
export function recordingWords({ created, duration, bytes, frames, lost, ended }: Recording, stream: string | null): string {
  const date = new Date(created).toLocaleString(language, { dateStyle: 'medium', timeStyle: 'short' });
  const words = [date, formatTime(duration), t('{frames} frames', { frames: formatCount(frames) }), formatBytes(bytes)];
  if (stream !== null) words.unshift(stream);
  if (lost > 0) words.push(t('{lost} lost', { lost: formatCount(lost) }));
  const ending = endingWords[ended ?? ''];
  if (ending) words.push(ending);
  return words.join(' · ');
}

/** The list item of one recording that has ended: a play button, and the other actions in a menu. */
export function recordingItem(recording: Recording, sight: RecordingSight, acts: RecordingActs): HTMLElement {
  const { id, name } = recording;
  const empty = recording.frames === 0 || recording.state === 'broken';
  return h(
    'li',
    { class: `recording${sight.open ? ' selected' : ''}`, 'data-recording': id },
    h(
      'div',
      { class: 'row' },
      h(
        'div',
        { class: 'grow recording-words' },
        h('strong', { title: name }, name),
        h('span', { class: 'muted small' }, recordingWords(recording, sight.stream)),
      ),
      h(
        'button',
        {
          type: 'button',
          class: 'quiet square small',
          'data-focus': `more-${id}`,
          'aria-label': t('More of {name}', { name }),
          title: t('Look, download, delete'),
          'aria-expanded': String(sight.open),
          on: { click: acts.toggle },
        },
        icon('more', 16),
      ),
      h(
        'button',
        {
          type: 'button',
          class: 'small',
          'data-focus': `play-${id}`,
          'aria-label': t('Play {name}', { name }),
          disabled: empty || sight.busy,
          on: { click: acts.play },
        },
        icon('play', 14),
        t('Play'),
      ),
    ),
    sight.open ? details(recording, sight, acts, empty) : null,
  );
}

function details(recording: Recording, sight: RecordingSight, acts: RecordingActs, empty: boolean): HTMLElement {
  const { id, name, duration, sound } = recording;
  const clock = h('span', { class: 'number' });
  const seek = h('input', {
    type: 'range',
    class: 'progress',
    min: 0,
    max: Math.max(1, duration),
    step: 1,
    value: sight.at ?? 0,
    'data-focus': `seek-${id}`,
    'aria-label': t('Moment of {name}', { name }),
    title: t('Show this moment on the head, on this page only'),
  });
  const tell = (): void => {
    const at = Number(seek.value);
    setText(clock, `${formatTime(at)} / ${formatTime(duration)}`);
    seek.setAttribute('aria-valuetext', formatTime(at));
    seek.style.setProperty('--to', `${(at / Math.max(1, duration)) * 100}%`);
  };
  seek.addEventListener('input', () => {
    tell();
    acts.look(Number(seek.value));
  });
  tell();
  return h(
    'div',
    { class: 'recording-more' },
    empty ? h('p', { class: 'muted small' }, t('There is nothing in it.')) : h('div', { class: 'row' }, seek, clock),
    h(
      'div',
      { class: 'row wrap', role: 'group', 'aria-label': t('Download {name} as', { name }) },
      formatsOf(sound).map(([format, title, meaning]) => {
        const button = h(
          'button',
          {
            type: 'button',
            class: 'small',
            'data-focus': `${format}-${id}`,
            title: meaning,
            disabled: empty || sight.busy,
            on: { click: () => acts.download(format) },
          },
          icon('download', 14),
          title,
        );
        if (format === 'glb') acts.needsFace(button);
        return button;
      }),
    ),
    h(
      'button',
      {
        type: 'button',
        class: 'quiet small',
        'data-focus': `delete-${id}`,
        'aria-label': t('Delete {name}', { name }),
        disabled: sight.busy,
        on: { click: acts.remove },
      },
      icon('trash', 14),
      t('Delete'),
    ),
  );
}

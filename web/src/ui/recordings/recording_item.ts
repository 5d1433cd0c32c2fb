import type { Recording, RecordingFormat } from '../../net/types.ts';
import { h, setText } from '../shared/dom.ts';
import { formatBytes, formatCount, formatTime } from '../shared/format.ts';
import { icon } from '../shared/icons.ts';

const formats: readonly [RecordingFormat, string, string][] = [
  ['performance', 'Performance', 'A performance document, JSON'],
  ['fap', '.fap', 'A .fap file, in whole FAP units'],
  ['arkit-csv', 'ARKit CSV', 'A take in the format of Live Link Face'],
  ['glb', 'GLB clip', 'The open head with its skin and one animation'],
  ['frames-json', 'Frames', 'Every frame, JSON'],
];

/** Why a recording ended, when no client stopped it. */
const endingWords: Record<string, string> = {
  'stream-ended': 'ended with its stream',
  'max-duration': 'ended at the maximum duration',
  'max-bytes': 'ended at the maximum size of a recording',
  'max-total-bytes': 'ended at the maximum size of all recordings',
  'max-token-bytes': 'ended at the maximum of what its token may store',
  'disk-full': 'ended: the disk is full',
  'server-stopped': 'ended with the server',
  'server-killed': 'cut off when the server was killed',
  damaged: 'its file is damaged',
};

export interface RecordingActs {
  play: () => void;
  remove: () => void;
  download: (format: RecordingFormat) => void;
  look: (at: number) => void;
  toggle: () => void;
}

export interface RecordingSight {
  open: boolean;
  busy: boolean;
  /** The displayed moment of this recording, ms; null when the face does not show this recording. */
  at: number | null;
  /** Whether a GLB clip can be made for the displayed head. */
  clip: boolean;
  /** Title of the stream, in a list of several streams; else null. */
  stream: string | null;
}

/** The facts of a recording in one line. */
export function recordingWords({ created, duration, bytes, frames, lost, ended }: Recording, stream: string | null): string {
  const date = new Date(created).toLocaleString('en-US', { dateStyle: 'medium', timeStyle: 'short' });
  const words = [date, formatTime(duration), `${formatCount(frames)} frames`, formatBytes(bytes)];
  if (stream !== null) words.unshift(stream);
  if (lost > 0) words.push(`${formatCount(lost)} lost`);
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
          'aria-label': `More of ${name}`,
          title: 'Look, download, delete',
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
          'aria-label': `Play ${name}`,
          disabled: empty || sight.busy,
          on: { click: acts.play },
        },
        icon('play', 14),
        'Play',
      ),
    ),
    sight.open ? details(recording, sight, acts, empty) : null,
  );
}

function details(recording: Recording, sight: RecordingSight, acts: RecordingActs, empty: boolean): HTMLElement {
  const { id, name, duration } = recording;
  const clock = h('span', { class: 'number' });
  const seek = h('input', {
    type: 'range',
    class: 'progress',
    min: 0,
    max: Math.max(1, duration),
    step: 1,
    value: sight.at ?? 0,
    'data-focus': `seek-${id}`,
    'aria-label': `Moment of ${name}`,
    title: 'Show this moment on the head, on this page only',
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
    empty ? null : h('div', { class: 'row' }, seek, clock),
    h(
      'div',
      { class: 'row wrap', role: 'group', 'aria-label': `Download ${name} as` },
      formats.map(([format, title, meaning]) =>
        h(
          'button',
          {
            type: 'button',
            class: 'small',
            'data-focus': `${format}-${id}`,
            title: format === 'glb' && !sight.clip ? 'Open a head that is parametrized' : meaning,
            disabled: empty || sight.busy || (format === 'glb' && !sight.clip),
            on: { click: () => acts.download(format) },
          },
          icon('download', 14),
          title,
        ),
      ),
    ),
    h(
      'button',
      {
        type: 'button',
        class: 'quiet small',
        'data-focus': `delete-${id}`,
        'aria-label': `Delete ${name}`,
        disabled: sight.busy,
        on: { click: acts.remove },
      },
      icon('trash', 14),
      'Delete',
    ),
  );
}

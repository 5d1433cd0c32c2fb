import { h, replace } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import type { LiveModel } from '../live/live_model.ts';
import type { RecordingsModel } from '../recordings/recordings_model.ts';
import type { SceneView } from '../stage/scene.ts';
import type { Signal } from '../shared/signal.ts';
import type { Tab } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

export interface DriverChipParts {
  driver: FaceDriver;
  live: LiveModel;
  /** Description of the clip that drives the face; null when none does. */
  clip: Signal<string | null>;
  recordings: RecordingsModel;
  scene: SceneView;
  tab: Signal<Tab>;
  /** The stream to subscribe to when no stream is followed. */
}

/** The chip on the stage that names what drives the face, with a button that lets the stream take over again. */
export function makeDriverChip({ driver, live, clip, recordings, scene, tab }: DriverChipParts): HTMLElement {
  /** Description of the clip or recording that drives the face; null when the sliders drive it. */
  const shown = (): string | null => {
    if (driver.source.value === 'recording') return recordings.looksAt;
    if (driver.source.value === 'speech') return t('Speaking');
    if (driver.source.value === 'microphone') return t('Listening');
    return driver.source.value === 'clip' ? clip.value : null;
  };
  const chip = h('div', { class: 'driver', role: 'status' });
  let drawn = '';
  const draw = (): void => {
    const status = live.status.value;
    chip.hidden = scene.performer.value === null || tab.value === 'points' || tab.value === 'fit';
    if (chip.hidden) return;
    // The list of streams is read anew all the time; a button that is replaced under the pointer cannot be pressed.
    const wanted = JSON.stringify([driver.source.value, status, live.following.value, live.demo?.id, shown()]);
    if (wanted === drawn) return;
    drawn = wanted;
    if (driver.source.value === 'stream' && status.kind !== 'off') {
      const words =
        status.kind === 'open'
          ? t('Live: {title}', { title: status.title ?? '' })
          : status.kind === 'ended'
            ? (status.reason ?? t('The stream ended'))
            : t('Connecting…');
      replace(
        chip,
        h('span', { class: `lamp lamp-${status.kind}` }),
        h('span', { class: 'driver-text' }, words),
        h(
          'button',
          {
            type: 'button',
            class: 'quiet square small',
            'aria-label': t('Pause the stream'),
            title: t('Pause'),
            on: { click: () => driver.release('stream') },
          },
          icon('pause', 15),
        ),
      );
      return;
    }
    const { demo } = live;
    const following = live.following.value !== null;
    const resume = (): void => {
      if (following) driver.byStream();
      else if (demo) live.subscribe(demo.id, demo.title);
    };
    const words = shown();
    replace(
      chip,
      h('span', { class: `lamp ${words === null ? 'lamp-hand' : 'lamp-open'}` }),
      h('span', { class: 'driver-text' }, words ?? t('By hand')),
      following || demo
        ? h(
            'button',
            { type: 'button', class: 'quiet small', on: { click: resume } },
            icon('play', 14),
            following ? t('Back to live') : t('Play the demo'),
          )
        : null,
    );
  };
  const watched = [driver.source, live.status, live.following, live.streams, clip, recordings.look, scene.performer, tab];
  for (const signal of watched) signal.watch(draw);
  return chip;
}

import { h, replace } from './dom.ts';
import { icon } from './icons.ts';
import type { LiveModel } from './live_model.ts';
import type { SceneView } from './scene.ts';
import type { Signal } from './signal.ts';
import type { Tab } from './studio.ts';

/** Says on the stage who moves the face, and lets the stream take over again. */
export function makeDriverChip(
  live: LiveModel,
  scene: SceneView,
  tab: Signal<Tab>,
  /** What a file that plays on this page shows, in words. */
  clip: Signal<string | null>,
  defaultStream: { id: string; title: string },
): HTMLElement {
  const chip = h('div', { class: 'driver', role: 'status' });
  const draw = (): void => {
    const status = live.status.value;
    chip.hidden = scene.performer.value === null || tab.value === 'points' || tab.value === 'fit';
    if (chip.hidden) return;
    if (live.driving.value && status.kind !== 'off') {
      const words =
        status.kind === 'open'
          ? `Live: ${status.title ?? ''}`
          : status.kind === 'ended'
            ? (status.reason ?? 'The stream ended')
            : 'Connecting…';
      replace(
        chip,
        h('span', { class: `lamp lamp-${status.kind}` }),
        h('span', { class: 'driver-text' }, words),
        h(
          'button',
          {
            type: 'button',
            class: 'quiet square small',
            'aria-label': 'Pause the stream',
            title: 'Pause',
            on: { click: () => live.driving.set(false) },
          },
          icon('pause', 15),
        ),
      );
      return;
    }
    const resume = (): void => {
      if (live.following.value === null) live.subscribe(defaultStream.id, defaultStream.title);
      else live.driving.set(true);
    };
    replace(
      chip,
      h('span', { class: `lamp ${clip.value === null ? 'lamp-hand' : 'lamp-open'}` }),
      h('span', { class: 'driver-text' }, clip.value ?? 'By hand'),
      h(
        'button',
        { type: 'button', class: 'quiet small', on: { click: resume } },
        icon('play', 14),
        live.following.value === null ? 'Play the demo' : 'Back to live',
      ),
    );
  };
  live.status.watch(draw);
  live.driving.watch(draw);
  live.following.watch(draw);
  scene.performer.watch(draw);
  tab.watch(draw);
  clip.watch(draw);
  return chip;
}

import { quickSet } from '../../face/quick_set.ts';
import type { Model } from '../../net/types.ts';
import { h, redraw, replace } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import { rove } from '../shared/roving.ts';
import type { StreamSpeechState } from '../speak/stream_speech_model.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import type { Signal } from '../shared/signal.ts';
import type { Studio } from '../shared/studio.ts';
import { isNarrow } from './layout.ts';
import { t } from '../../words/words.ts';

export interface StepsParts {
  studio: Studio;
  /** Opens the chooser of model files. */
  upload: () => void;
  /** The example that shows most of what a face can do: whether it plays now, and what starts and pauses it. */
  example: { playing: Signal<boolean>; toggle: () => void };
  driver: Pick<FaceDriver, 'source'>;
  /** What the open head says into a stream. */
  streamSpeech: Signal<StreamSpeechState>;
}

/** Which of the four steps are done for the open head: it is there, has its first points, moves, has talked. */
export function doneSteps(model: Model | null, talked: boolean): [boolean, boolean, boolean, boolean] {
  const moves = model?.state === 'parametrized';
  const isRead = moves || model?.state === 'ready';
  return [isRead, moves || (isRead && model.feature_point_count >= quickSet.length), moves, moves && talked];
}

/**
 * What the studio is in one sentence, the four steps of a head with what is done of them, and the best example. It stands below the
 * heads or, where these are a tab, above the panel of the face, until all is done.
 */
export function stepsBox({ studio, upload, example, driver, streamSpeech }: StepsParts, wideSeat: HTMLElement, narrowSeat: HTMLElement): void {
  const list = h('ol', { class: 'steps-list', 'aria-label': t('Four steps') });
  const play = h('button', { type: 'button', class: 'steps-play', on: { click: () => example.toggle() } });
  const box = h(
    'section',
    { class: 'steps' },
    h('p', {}, t('Semblante makes any 3D head talk, in four steps:')),
    list,
    play,
  );
  rove(list, 'button');
  const steps: { title: string; go: () => void }[] = [
    { title: t('Add a head'), go: upload },
    { title: t('Place its points'), go: () => studio.tab.set('points') },
    { title: t('Make it move'), go: () => studio.tab.set('points') },
    { title: t('Let it talk'), go: () => studio.tab.set('animate') },
  ];
  const narrow = isNarrow();
  /** The heads that have said something on this page. */
  const talked = new Set<string>();
  const draw = (): void => {
    const model = studio.selected.value;
    const done = doneSteps(model, model !== null && talked.has(model.id));
    const next = done.indexOf(false);
    redraw(list, () =>
      replace(
        list,
        ...steps.map(({ title, go }, i) =>
          h(
            'li',
            { class: done[i] ? 'done' : '' },
            h(
              'button',
              { type: 'button', class: 'quiet small', 'data-focus': `step-${i}`, 'aria-current': i === next ? 'step' : null, on: { click: go } },
              h('span', { class: 'step-number', 'aria-hidden': 'true' }, done[i] ? icon('check', 13) : String(i + 1)),
              h('span', { class: 'visually-hidden' }, done[i] ? t('Done: ') : t('Step {number}: ', { number: i + 1 })),
              title,
            ),
          ),
        ),
      ),
    );
    play.hidden = model?.state !== 'parametrized';
    replace(play, icon(example.playing.value ? 'pause' : 'play', 15), example.playing.value ? t('Pause the example') : t('Play a minute'));
    box.hidden = narrow.matches && next < 0 && !example.playing.value;
  };
  const seat = (): void => {
    if (narrow.matches) narrowSeat.prepend(box);
    else wideSeat.append(box);
    draw();
  };
  narrow.addEventListener('change', seat);
  studio.selected.watch(draw);
  example.playing.watch(draw);
  driver.source.watch((source) => {
    const { value: model } = studio.selected;
    if (model && (source === 'speech' || source === 'clip' || source === 'microphone')) talked.add(model.id);
    draw();
  });
  streamSpeech.watch(({ kind }) => {
    const { value: model } = studio.selected;
    if (model && kind === 'speaking') talked.add(model.id);
    draw();
  });
  seat();
}

import { writeTake, type Library } from '@client/motion/index.ts';
import { HandRecording } from '../../face/hand_recording.ts';
import { writtenRate } from '../../face/motion_frames.ts';
import { h, setText } from '../shared/dom.ts';
import { formatTime } from '../shared/format.ts';
import { icon } from '../shared/icons.ts';
import { needsFace } from '../shared/needs_face.ts';
import type { Signal } from '../shared/signal.ts';
import type { Studio } from '../shared/studio.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import { t } from '../../words/words.ts';

export interface HandRecorderParts {
  studio: Studio;
  driver: FaceDriver;
  /** Whether the animated face is on the stage. */
  faceShown: Signal<boolean>;
  /** Gives the library that writes .fap files. */
  load: () => Promise<Library>;
  /** Opens the recorded file, which then plays, loops and is exported as any other. */
  take: (file: File) => Promise<void>;
}

/** The button that records what is done with the sliders and buttons of the Animate tab, and opens it as a file. */
export function handRecorderButton({ studio, driver, faceShown, load, take }: HandRecorderParts): HTMLButtonElement {
  const label = h('span', { class: 'number' }, t('Record by hand'));
  const button = h(
    'button',
    { type: 'button', class: 'quiet', title: t('Record what you do with the sliders, to play and save it'), 'aria-pressed': 'false' },
    icon('record', 16),
    label,
  );
  let recording: HandRecording | null = null;
  let timer = 0;
  const sample = (): void => {
    if (!recording) return;
    // While a stream drives the face there is no frame: the last one goes on.
    const state = driver.shownFrame()?.state ?? recording.frames.at(-1)?.state;
    if (state) recording.add(performance.now(), state);
    // Whole seconds: a button whose width changes all the time is hard to press.
    setText(label, t('Stop, {time}', { time: formatTime(Math.floor(recording.frames.length / writtenRate) * 1000) }));
    if (recording.full) void stop();
  };
  const start = (): void => {
    if (driver.source.value === 'stream') driver.byHand();
    recording = new HandRecording(performance.now());
    button.setAttribute('aria-pressed', 'true');
    sample();
    timer = window.setInterval(sample, 1000 / writtenRate);
  };
  const stop = async (): Promise<void> => {
    const done = recording;
    recording = null;
    clearInterval(timer);
    button.setAttribute('aria-pressed', 'false');
    setText(label, t('Record by hand'));
    if (!done) return;
    await studio.attempt(t('The recording was not made'), async () => {
      const bytes = writeTake(await load(), 'fap', done.frames, writtenRate);
      await take(new File([bytes as Uint8Array<ArrayBuffer>], `${t('by hand')}.fap`));
    });
  };
  button.addEventListener('click', () => {
    if (recording) void stop();
    else start();
  });
  const set = needsFace(button, button.title, studio);
  faceShown.watch((face) => {
    set(face);
    if (!face && recording) void stop();
  });
  return button;
}

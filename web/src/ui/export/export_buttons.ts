import { writeTake, type Library } from '@client/motion/index.ts';
import { framesOfClip, writtenRate, type Motion } from '../../face/motion_frames.ts';
import { h, setText } from '../shared/dom.ts';
import { icon, type IconName } from '../shared/icons.ts';
import type { Studio } from '../shared/studio.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import type { SceneView } from '../stage/scene.ts';
import { VideoRecorder } from './video_recorder.ts';
import { t } from '../../words/words.ts';

export interface ExportParts {
  studio: Studio;
  scene: SceneView;
  driver: FaceDriver;
  /** What a speech is heard through. */
  sound: HTMLAudioElement;
  /** Gives the library that writes .fap files. */
  load: () => Promise<Library>;
  save: (content: Blob, name: string) => void;
}

/** Buttons that save what is on the stage: a picture, a video, a .fap file. */
export function exportButtons(parts: ExportParts): HTMLElement[] {
  const { studio, scene, save } = parts;
  const nameOfFile = (ending: string): string => `${(studio.selected.value?.name ?? t('Head')).replaceAll(/[^\p{L}\p{N}._ -]+/gu, '-').slice(0, 80)}${ending}`;
  const picture = button(t('Picture'), 'picture', t('Save the picture as PNG, without the background'), () =>
    studio.attempt(t('The picture was not saved'), async () => {
      const content = await scene.stage.picture();
      if (!content) throw new Error(t('The browser made no picture.'));
      save(content, nameOfFile('.png'));
    }),
  );
  const fap = button('.fap', 'download', t('Save the motion as a .fap file: the open file or speech, else this face'), () =>
    studio.attempt(t('The .fap file was not saved'), async () => {
      const { frames, steps, rate } = motionOf(parts.driver);
      const bytes = writeTake(await parts.load(), 'fap', frames, rate, steps);
      save(new Blob([bytes as Uint8Array<ArrayBuffer>], { type: 'text/plain' }), nameOfFile('.fap'));
    }),
  );
  const video = videoButton(parts, (content) => save(content, nameOfFile('.webm')));
  const buttons = [picture, video, fap];
  scene.faceShown.watch((face) => {
    for (const one of buttons) one.disabled = !face;
  });
  return buttons;
}

/** What plays on the face, else the one frame that is on it. Throws for a stream, whose frames pass by. */
function motionOf(driver: FaceDriver): Motion {
  const clip = driver.shownClip;
  if (clip) return framesOfClip(clip);
  const shown = driver.shownFrame();
  if (!shown) throw new Error(t('A stream is saved by a recording: see the Live tab.'));
  return { frames: [{ time: 0, state: shown.state }], steps: shown.steps, rate: writtenRate };
}

/** Starts and stops a video; one that began while a clip or speech played stops with it. */
function videoButton({ studio, scene, driver, sound }: ExportParts, save: (content: Blob) => void): HTMLButtonElement {
  const recorder = new VideoRecorder(scene.stage, sound);
  const label = h('span', {}, t('Video'));
  const made = button(label, 'record', t('Record what is seen and heard as WebM'), async () => {
    if (recorder.running) return recorder.stop();
    await studio.attempt(t('The video was not saved'), async () => {
      const content = recorder.record(() => driver.plays);
      setText(label, t('Stop and save'));
      made.setAttribute('aria-pressed', 'true');
      try {
        save(await content);
      } finally {
        setText(label, t('Video'));
        made.setAttribute('aria-pressed', 'false');
      }
    });
  });
  made.setAttribute('aria-pressed', 'false');
  return made;
}

function button(label: string | HTMLElement, name: IconName, title: string, act: () => Promise<unknown> | void): HTMLButtonElement {
  return h('button', { type: 'button', class: 'quiet', title, on: { click: () => void act() } }, icon(name, 16), label);
}

import { writeTake, type Library } from '@client/motion/index.ts';
import { PerformanceClip } from '../../face/performance_clip.ts';
import { framesOfClip, writtenRate, type Motion } from '../../face/motion_frames.ts';
import { h, setText } from '../shared/dom.ts';
import { icon, type IconName } from '../shared/icons.ts';
import { needsFace } from '../shared/needs_face.ts';
import type { Signal } from '../shared/signal.ts';
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
  /** What is heard of the followed stream. */
  streamed: Signal<AudioNode | null>;
  /** Gives the library that writes .fap files. */
  load: () => Promise<Library>;
  save: (content: Blob, name: string) => void;
}

/** Buttons that save what is on the stage: a picture, a video, the motion with or without the head, the head. */
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
  const saveFromServer = (failure: string, ending: string, fetch: (model: string, level: number) => Promise<Blob>): Promise<unknown> =>
    studio.attempt(failure, async () => {
      const model = studio.selected.value;
      if (model) save(await fetch(model.id, scene.level.value), nameOfFile(ending));
    });
  const fap = button('.fap', 'download', t('Save the motion as a .fap file: the open file or speech, else this face'), () =>
    studio.attempt(t('The .fap file was not saved'), async () => save(await fapOf(parts), nameOfFile('.fap'))),
  );
  const clip = button(t('GLB clip'), 'download', t('Save the head with the motion for other programs: the open file or speech, else this face'), () =>
    saveFromServer(t('The GLB clip was not saved'), '-clip.glb', async (model, level) =>
      studio.api.makeClip(model, level, performanceOf(parts.driver) ?? (await fapOf(parts))),
    ),
  );
  const performance = button(t('Performance'), 'download', t('Save the open performance or speech as a document'), () =>
    studio.attempt(t('The performance was not saved'), async () => {
      const document = performanceOf(parts.driver, true);
      if (!document) throw new Error(t('There is none yet: open a performance, or let the head say something.'));
      save(document, nameOfFile('.json'));
    }),
  );
  const face = button(t('Face package'), 'download', t('Save the head with its weights in one file, for the clients'), () =>
    saveFromServer(t('The face package was not saved'), '.glb', (model, level) => studio.api.getFace(model, level)),
  );
  const video = videoButton(parts, (content) => save(content, nameOfFile('.webm')));
  const buttons = [picture, video, clip, performance, fap, face];
  const withFace = buttons.map((one) => needsFace(one, one.title, studio));
  scene.faceShown.watch((face) => withFace.forEach((set) => set(face)));
  return buttons;
}

/** The document of the performance or speech that plays; null for other motion, and unless `endless` also for one without an end. */
function performanceOf(driver: FaceDriver, endless = false): Blob | null {
  const clip = driver.clipToSave;
  if (!(clip instanceof PerformanceClip) || (clip.duration === Infinity && !endless)) return null;
  return new Blob([clip.document], { type: 'application/json' });
}

async function fapOf({ driver, load }: ExportParts): Promise<Blob> {
  const { frames, steps, rate } = motionOf(driver);
  const bytes = writeTake(await load(), 'fap', frames, rate, steps);
  return new Blob([bytes as Uint8Array<ArrayBuffer>], { type: 'text/plain' });
}

/** What plays on the face, else the one frame that is on it. Throws for a stream, whose frames pass by. */
function motionOf(driver: FaceDriver): Motion {
  const clip = driver.clipToSave;
  if (clip) return framesOfClip(clip);
  const shown = driver.shownFrame();
  if (!shown) throw new Error(t('A stream is saved by a recording: see the Live tab.'));
  return { frames: [{ time: 0, state: shown.state }], steps: shown.steps, rate: writtenRate };
}

/** Starts and stops a video; one that began while a clip or speech played stops with it. */
function videoButton({ studio, scene, driver, sound, streamed }: ExportParts, save: (content: Blob) => void): HTMLButtonElement {
  const recorder = new VideoRecorder(scene.stage, sound, streamed);
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

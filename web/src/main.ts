import './ui/styles/index.css';
import { neutralFrame } from '@client/index.ts';
import { dracoDecoder } from './face/draco.ts';
import { loadLibrary, loadRuntime } from './face/runtime.ts';
import { loadStageFace, loadStillFace, type FaceSources } from './face/package.ts';
import { Api } from './net/api.ts';
import type { Session } from './net/types.ts';
import { AnimatePanel } from './ui/animate/animate_panel.ts';
import { Address } from './ui/page/address.ts';
import { codeButton } from './ui/code/code_dialog.ts';
import { ComparePanel } from './ui/compare/compare_panel.ts';
import { ClipPanel } from './ui/animate/clip_panel.ts';
import { DraftStore } from './ui/points/draft_store.ts';
import { exportButtons } from './ui/export/export_buttons.ts';
import { handRecorderButton } from './ui/animate/hand_recorder.ts';
import { h } from './ui/shared/dom.ts';
import { HiddenParts } from './ui/points/hidden_parts.ts';
import { hideParts } from './ui/page/part_hiding.ts';
import { SettingsStore } from './ui/points/settings_store.ts';
import { makeDriverChip } from './ui/page/driver_chip.ts';
import { FaceDriver } from './ui/stage/face_driver.ts';
import { flyToPoints } from './ui/page/point_flight.ts';
import { routeDrops } from './ui/page/file_drop.ts';
import { pointOutFindings } from './ui/fit/fit_highlight.ts';
import { FitModel } from './ui/fit/fit_model.ts';
import { FitPanel } from './ui/fit/fit_panel.ts';
import { influenceLegend } from './ui/influence/influence_legend.ts';
import { InfluenceModel } from './ui/influence/influence_model.ts';
import { InfluencePanel } from './ui/influence/influence_panel.ts';
import { InfluenceReader } from './ui/influence/influence_reader.ts';
import { exposeInspection } from './ui/page/inspect.ts';
import { keepFocus } from './ui/page/kept_focus.ts';
import { makeLayout } from './ui/page/layout.ts';
import { keySheetButton } from './ui/page/key_sheet.ts';
import { languageSelect } from './ui/page/language.ts';
import { errorsNotice } from './ui/animate/errors_notice.ts';
import { noFaceNotice } from './ui/animate/no_face_notice.ts';
import { mendButton } from './ui/fit/mend.ts';
import { LevelsPanel } from './ui/animate/levels_panel.ts';
import { LiveSound } from './ui/live/live_sound.ts';
import { LiveCaptions } from './ui/live/live_captions.ts';
import { LiveOverlay } from './ui/live/live_overlay.ts';
import { LiveModel } from './ui/live/live_model.ts';
import { LivePanel } from './ui/live/live_panel.ts';
import { Parametrizer } from './ui/points/parametrizer.ts';
import { PerformanceModel } from './ui/live/performance_model.ts';
import { PerformancePanel } from './ui/live/performance_panel.ts';
import { MirrorLock } from './ui/points/mirror_lock.ts';
import { PointPicker } from './ui/page/point_picker.ts';
import { PointsModel } from './ui/points/points_model.ts';
import { PointsPanel } from './ui/points/points_panel.ts';
import { startPolling } from './ui/page/polling.ts';
import { RecordingsModel } from './ui/recordings/recordings_model.ts';
import { RecordingsPanel } from './ui/recordings/recordings_panel.ts';
import { messageOf } from './ui/shared/message_of.ts';
import { saveFile } from './ui/shared/save_file.ts';
import { scansBox } from './ui/scans/scans_box.ts';
import { ScansModel } from './ui/scans/scans_model.ts';
import { SceneView } from './ui/stage/scene.ts';
import { letIn, signedOutNote, signOutButton } from './ui/page/sign_in.ts';
import { Shelf } from './ui/heads/shelf.ts';
import { offlineNote } from './ui/page/offline_note.ts';
import { addSampleHead } from './ui/page/sample_head.ts';
import { stepsBox } from './ui/page/steps.ts';
import { progressSaid } from './ui/page/progress_said.ts';
import { StagePanel } from './ui/page/stage_panel.ts';
import { MicrophoneModel } from './ui/speak/microphone_model.ts';
import { SpeakModel } from './ui/speak/speak_model.ts';
import { SpeakPanel } from './ui/speak/speak_panel.ts';
import { SpeechForm } from './ui/speak/speech_form.ts';
import { StreamSpeechBox } from './ui/speak/stream_speech_box.ts';
import { StreamSpeechModel } from './ui/speak/stream_speech_model.ts';
import { StreamSpeechPanel } from './ui/speak/stream_speech_panel.ts';
import { Studio } from './ui/shared/studio.ts';
import { UnitsPanel } from './ui/units/units_panel.ts';
import { themeButton } from './ui/page/theme.ts';
import { takeThumbnails } from './ui/heads/thumbnails.ts';
import { forgetThumbnails, ThumbnailStore } from './ui/heads/thumbnail_store.ts';
import { keepOffline } from '../offline/register.ts';
import { language, loadServerWords, t } from './words/words.ts';
import { JobStore } from './ui/shared/job_store.ts';
import { browserStorage, tabStorage } from './ui/shared/storage.ts';
import { Toasts } from './ui/shared/toast.ts';

/** Composes the page; the only module that knows all others. */
function main(root: HTMLElement, base: string, session: Session | null, theme: HTMLElement): void {
  const toasts = new Toasts();
  const api = new Api(base);
  const extras = h('div', { class: 'row' }, signOutButton(api.base, session, forgetThumbnails), keySheetButton(), languageSelect(), theme);
  const canvas = h('canvas', { class: 'canvas' });

  const studio = new Studio(api, toasts, new JobStore(tabStorage()));
  const drafts = new DraftStore(browserStorage());
  const settings = new SettingsStore(browserStorage());
  const points = new PointsModel(studio, drafts, new MirrorLock(studio, settings));
  const hidden = new HiddenParts(studio, settings);
  studio.onRemoved = (id) => {
    drafts.forget(id);
    settings.forget(id);
  };
  studio.onChangedElsewhere = (model) => void points.update(model);
  const fit = new FitModel(studio);
  const parametrizer = new Parametrizer(studio, points);
  const frame = neutralFrame();
  const driver = new FaceDriver(frame);
  const live = new LiveModel(studio, frame, driver);
  const recordings = new RecordingsModel(studio, live, driver, saveFile);
  const scene = makeScene(canvas, api);
  const liveSound = new LiveSound(live, driver, () => scene.performer.value?.player.stats ?? null);
  scene.clock = () => liveSound.mediaTime;

  const sound = new Audio();
  const influence = new InfluenceModel(scene);
  const reader = new InfluenceReader(canvas, scene, influence);
  const compare = new ComparePanel(studio, scene, parametrizer, async (onClose) => {
    const { CompareView } = await import('./ui/compare/compare_view.ts');
    return new CompareView({ scene, influence, driver, onClose, makeScene: (second) => makeScene(second, api) });
  });
  const animate = new AnimatePanel({
    frame,
    toasts,
    exports: [
      handRecorderButton({ studio, driver, faceShown: scene.faceShown, load: loadLibrary, take: (file) => clip.takeFile(file) }),
      codeButton(studio, live, driver), ...exportButtons({ studio, scene, driver, sound, streamed: liveSound.output, load: loadLibrary, save: saveFile }),
    ],
    views: [
      new InfluencePanel(influence, scene).element,
      new UnitsPanel(scene, points, studio, parametrizer).element,
      compare.element,
    ],
    ownExpressions: scansBox(studio, new ScansModel(studio)),
    onFap: (fap, mirror) => influence.useFap(fap, mirror),
    onChange: () => {
      driver.byHand();
      live.touch();
    },
    onIdle: (on) => driver.setIdle(on ? loadLibrary : null),
    onJawTakesLip: (takes) => {
      scene.jawTakesLip = takes;
      driver.byHand();
    },
  });
  const clip = new ClipPanel(driver, loadLibrary, saveFile, toasts);
  const speech = new SpeakModel(api, driver, sound, loadLibrary);
  const microphone = new MicrophoneModel(frame, driver, loadLibrary, (time) => live.touch(time), (packet, time) => live.say(packet, time));
  const streamSpeech = new StreamSpeechModel(api, live);
  const voices = api.voices();
  const makeForm = (say: () => void): SpeechForm => new SpeechForm(voices, say);
  const inStream = {
    model: streamSpeech,
    live,
    showRecording: (stream: string, recording: string): void => {
      studio.tab.set('live');
      recordingsPanel.reveal(stream, recording);
    },
  };
  const speak = new SpeakPanel(speech, microphone, api, makeForm, (make) => new StreamSpeechBox(inStream, make).element);
  // A page that the browser keeps for Back still has its speech.
  window.addEventListener('pagehide', ({ persisted }) => {
    if (persisted) return;
    speech.leave();
    streamSpeech.leave();
    live.leave();
  });
  animate.element.prepend(noFaceNotice(studio), errorsNotice(studio, mendButton(studio, fit, parametrizer)), speak.element); // what everybody wants first of a head: that it talks
  animate.element.append(clip.element, new LevelsPanel(studio, fit, scene).element);
  const shelf = new Shelf(studio);
  const fitPanel = new FitPanel(studio, points, fit, parametrizer);
  const performance = new PerformancePanel(new PerformanceModel(studio, live), live, toasts);
  const recordingsPanel = new RecordingsPanel(recordings, live, studio);
  const overlay = new LiveOverlay(live, driver);
  const captions = new LiveCaptions(live, driver, () => scene.performer.value?.player.stats ?? null, () => liveSound.mediaTime);
  const livePanel = new LivePanel(studio, live, liveSound, new StreamSpeechPanel(makeForm, inStream).element, performance.element, recordingsPanel.element, { figures: overlay.on, captions: captions.on });
  const chip = makeDriverChip({ driver, live, clip: clip.shown, recordings, scene, tab: studio.tab });
  const picker = new PointPicker(scene, points, hidden);
  const stagePanel = new StagePanel(canvas, scene, studio, points, picker, [chip, compare.label], influence.on);
  stagePanel.element.append(influenceLegend(influence, scene), overlay.element, captions.element, reader.element, reader.said);
  // Loaded when points can be dragged, not with the first picture.
  const untilPoints = studio.tab.watch((tab) => {
    if (tab !== 'points') return;
    queueMicrotask(() => untilPoints());
    void studio.attempt(t('Points cannot be dragged: a part of the page was not loaded'), async () => {
      const { PointDrag } = await import('./ui/page/point_drag.ts');
      stagePanel.element.append(new PointDrag(canvas, scene, studio, points, picker).element);
    });
  });
  const pointsPanel = new PointsPanel(studio, points, parametrizer, hidden);
  const panels = {
    heads: shelf.element,
    fit: fitPanel.element,
    points: pointsPanel.element,
    animate: animate.element,
    live: livePanel.element,
  };
  const back = async (): Promise<void> => {
    toasts.serverIsBack();
    await Promise.all([studio.start(), live.refresh()]);
    if (scene.state.value.kind === 'failed' && studio.selected.value) void scene.open(studio.selected.value);
  };
  extras.prepend(shelf.addButton('narrow-only'));
  const layout = makeLayout(studio, panels, [stagePanel.element, compare.seat], extras, [offlineNote(api.base, () => void back()), signedOutNote(api.base, () => void back())]);
  layout.append(progressSaid(studio, scene), toasts.element);
  root.replaceChildren(layout);
  keepFocus(layout);

  scene.animate = (delta) => driver.step(delta);
  live.subscriber.watch((subscriber) => driver.setClient(subscriber?.client ?? null));
  scene.performer.watch((performer) => {
    animate.showFace(performer?.pose ?? null);
    driver.setFace(performer);
  });
  stagePanel.onUpload = shelf.choose;
  stagePanel.onRemove = (model) => void studio.remove(model);
  stagePanel.onSample = () => void addSampleHead(studio, points, parametrizer);
  const example = { playing: clip.examplePlays, toggle: () => void clip.toggleExample() };
  stepsBox({ studio, upload: shelf.choose, example, driver, streamSpeech: streamSpeech.state }, shelf.element, animate.element);
  stagePanel.onPart = (part) => fitPanel.revealPart(part);
  pointOutFindings(studio, fit, points, scene);
  flyToPoints(studio, points, scene);
  points.imageOf = (id, of, middle) => picker.imageOf(id, of, middle);
  points.positionOf = (vertex) => scene.preview?.positionOf(vertex)?.toArray() ?? null;
  showSelected(studio, points, scene);
  translateServer(studio, fit, scene);
  hideParts(canvas, scene, studio, hidden);
  takeThumbnails(studio, scene, shelf, new ThumbnailStore(), {
    preview: (id, most) => api.smallPreview(id, most),
    face: (id, level, most) => loadStillFace(faceSources(api), id, level, most),
  });
  const shown = scene.state.watch(({ kind }) => {
    if (kind !== 'ready') return;
    queueMicrotask(() => shown());
    // The first head is what is kept first; the development server's pages change all the time.
    if (import.meta.env.PROD) keepOffline();
    // Without a stream that moves the first face it lives by itself, where motion is welcome.
    const isStill = driver.source.value === 'hand' && live.following.value === null;
    if (isStill && scene.faceShown.value && !matchMedia('(prefers-reduced-motion: reduce)').matches) animate.enliven();
  });
  routeDrops(layout, { studio, points: pointsPanel, performance, clip, speak });
  startPolling({ studio, scene, live, livePanel, overlay, recordings, performance, clip });

  const address = new Address(studio, points, live);
  void Promise.all([studio.start(), live.refresh()]).then(() => address.start());
  exposeInspection(scene, studio, driver, live, sound, microphone);
}

const faceSources = (api: Api): FaceSources => ({
  base: api.base,
  draco: dracoDecoder,
  runtime: loadRuntime,
  image: (sha256, signal) => api.content(sha256, signal),
});

function makeScene(canvas: HTMLCanvasElement, api: Api): SceneView {
  const sources = faceSources(api);
  return new SceneView(canvas, {
    preview: (model, signal) => api.preview(model.id, signal),
    face: (model, level, signal) => loadStageFace(sources, model.id, level, signal),
  });
}

/** Loads the words for what the server says after the first picture, and shows them where it has said something already. */
function translateServer(studio: Studio, fit: FitModel, scene: SceneView): void {
  const untilPicture = scene.state.watch(({ kind }) => {
    if (kind !== 'ready' && kind !== 'failed') return;
    queueMicrotask(() => untilPicture());
    void loadServerWords().then((areThere) => {
      if (areThere) for (const signal of [scene.state, fit.report, studio.selected]) signal.notify();
    });
  });
}

/** Shows the selected head on the stage in the form that the open tab needs, and loads its feature points. */
function showSelected(studio: Studio, points: PointsModel, scene: SceneView): void {
  studio.tab.watch((tab) => {
    scene.show(tab === 'points' || tab === 'fit' ? 'preview' : 'face');
    // A chosen point has the camera in front of it.
    if (tab === 'animate' || tab === 'live' || (tab === 'points' && points.chosen.value === null)) scene.stage.lookBack();
  });
  let opened = '';
  studio.selected.watch((model) => {
    void scene.open(model);
    // The points can be loaded once the import has ended; later changes of the model must not overwrite the draft.
    const key = model ? `${model.id}:${model.state === 'importing' || model.state === 'failed'}` : '';
    if (key === opened) return;
    opened = key;
    void points.open(model);
  });
}

const root = document.querySelector<HTMLElement>('#studio');
document.documentElement.lang = language;
if (root) {
  const theme = themeButton(); // the sign-in has its colours too
  // The server's own path: behind a proxy the studio may lie below a path.
  const base = new URL('.', document.baseURI).pathname.replace(/\/$/, '');
  letIn(base, root)
    .then((session) => {
      main(root, base, session, theme);
    })
    .catch((error: unknown) => {
      root.replaceChildren(
        h(
          'div',
          { class: 'no-stage', role: 'alert' },
          h('h1', {}, 'Semblante'),
          h('p', {}, messageOf(error)),
        ),
      );
    });
}

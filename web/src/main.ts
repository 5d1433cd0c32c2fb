import './ui/styles/index.css';
import { compileKernel, neutralFrame } from '@client/index.ts';
import { ClipPlayer } from './face/clip.ts';
import { dracoDecoder } from './face/draco.ts';
import { IdleLife } from './face/idle_life.ts';
import { loadFace } from './face/package.ts';
import { Api } from './net/api.ts';
import { AnimatePanel } from './ui/animate_panel.ts';
import { ClipPanel } from './ui/clip_panel.ts';
import { h } from './ui/dom.ts';
import { FitModel } from './ui/fit_model.ts';
import { FitPanel } from './ui/fit_panel.ts';
import { pointOutFindings } from './ui/fit_highlight.ts';
import { makeDriverChip } from './ui/driver_chip.ts';
import { dropPlace, type DropPlace } from './ui/drop_place.ts';
import { makeLayout } from './ui/layout.ts';
import { exposeInspection } from './ui/inspect.ts';
import { LevelsPanel } from './ui/levels_panel.ts';
import { LiveModel } from './ui/live_model.ts';
import { LivePanel } from './ui/live_panel.ts';
import { Parametrizer } from './ui/parametrizer.ts';
import { PerformanceModel } from './ui/performance_model.ts';
import { PerformancePanel } from './ui/performance_panel.ts';
import { PointsModel } from './ui/points_model.ts';
import { PointsPanel } from './ui/points_panel.ts';
import { RecordingsModel } from './ui/recordings_model.ts';
import { RecordingsPanel } from './ui/recordings_panel.ts';
import { saveFile } from './ui/save_file.ts';
import { SceneView } from './ui/scene.ts';
import { acceptDrops, Shelf } from './ui/shelf.ts';
import { Signal } from './ui/signal.ts';
import { StagePanel } from './ui/stage_panel.ts';
import { Studio } from './ui/studio.ts';
import { themeButton } from './ui/theme.ts';
import { Toasts } from './ui/toast.ts';

const demo = { id: 'demo', title: 'Demo' };
/** A calm person; the same every time, as everything here. */
const idleSettings = { seed: 1, blinksPerMinute: 15, head: 0.3, eyes: 0.5 };

/** Puts the page together; the only place that knows everyone. */
function main(root: HTMLElement): void {
  const toasts = new Toasts();
  const theme = themeButton();
  const api = new Api();
  const studio = new Studio(api, toasts);
  const points = new PointsModel(studio);
  const fit = new FitModel(studio);
  const frame = neutralFrame();
  const live = new LiveModel(studio, frame);
  const faceSources = {
    base: api.base,
    draco: dracoDecoder,
    kernel: kernelModule,
    image: (sha256: string, signal: AbortSignal) => api.content(sha256, signal),
  };
  const canvas = h('canvas', { class: 'canvas' });
  const scene = new SceneView(canvas, {
    preview: (model, signal) => api.preview(model.id, signal),
    face: (model, level, signal) => loadFace(faceSources, model.id, level, signal),
  });

  const clipPlayer = new ClipPlayer();
  scene.clip = clipPlayer;
  const clip = new ClipPanel(clipPlayer, () => {
    recordings.look.set(null);
    live.driving.set(false);
  });
  const recordings = new RecordingsModel(
    studio,
    live,
    (moment) => {
      clip.release();
      live.driving.set(false);
      scene.held = true;
      scene.performer.value?.follow(moment);
    },
    saveFile,
  );
  const takeByHand = (): void => {
    clip.release();
    recordings.look.set(null);
    live.driving.set(false);
    scene.performer.value?.follow(frame);
  };
  const animate = new AnimatePanel({
    frame,
    onChange: () => {
      takeByHand();
      live.touch();
    },
    onIdle: (on) => {
      scene.idle = on ? new IdleLife(frame, idleSettings) : null;
      // Who switches it on wants to see it; switched off, it leaves the face to whoever moves it.
      if (on || (!live.driving.value && !clipPlayer.shown)) takeByHand();
    },
  });
  animate.element.append(clip.element);
  animate.element.append(new LevelsPanel(studio, fit, scene).element);
  const thumbnails = new Map<string, string>();
  const shelf = new Shelf(studio, thumbnails);
  const parametrizer = new Parametrizer(studio, points);
  const fitPanel = new FitPanel(studio, points, fit, parametrizer);
  /** What the face shows of a file or a recording. */
  const shown = new Signal<string | null>(null);
  const tell = (): void => shown.set(recordings.looksAt ?? clip.shown.value);
  clip.shown.watch(tell);
  recordings.look.watch((look) => {
    if (look === null) scene.held = false;
    tell();
  });
  const stagePanel = new StagePanel(canvas, scene, studio, points, makeDriverChip(live, scene, studio.tab, shown, demo));
  const performance = new PerformancePanel(new PerformanceModel(studio, live), live);
  const livePanel = new LivePanel(
    studio,
    live,
    performance.element,
    new RecordingsPanel(recordings, live, studio).element,
  );
  const layout = makeLayout(
    studio,
    {
      heads: shelf.element,
      fit: fitPanel.element,
      points: new PointsPanel(studio, points, parametrizer).element,
      animate: animate.element,
      live: livePanel.element,
    },
    stagePanel.element,
    theme,
  );
  root.replaceChildren(layout, toasts.element);
  acceptDrops(layout, (files) => {
    const going = (place: DropPlace): File[] => files.filter(({ name }) => dropPlace(name, studio.tab.value) === place);
    const [script, file] = [going('stream').at(-1), going('page').at(-1)];
    const heads = going('heads');
    if (script) {
      studio.tab.set('live');
      void performance.takeFile(script);
    } else if (file) {
      studio.tab.set('animate');
      void clip.takeFile(file);
    }
    void studio.upload(heads);
  });

  live.driving.watch((driving) => {
    if (driving) {
      clip.release();
      recordings.look.set(null);
    } else scene.performer.value?.follow(frame);
  });
  live.driving.watch((driving) => (scene.live = driving));
  const listen = (): void => scene.performer.value?.listen(live.subscriber.value?.client ?? null);
  live.subscriber.watch(listen);
  scene.performer.watch((performer) => {
    animate.showFace(performer?.pose ?? null);
    recordings.look.set(null);
    performer?.follow(frame);
    clip.showAgain();
    listen();
  });

  studio.tab.watch((tab) => scene.show(tab === 'points' || tab === 'fit' ? 'preview' : 'face'));
  studio.tab.watch((tab) => {
    if (tab === 'animate' || tab === 'live') scene.stage.lookBack();
  });
  stagePanel.onPart = (part) => fitPanel.revealPart(part);
  pointOutFindings(studio, fit, points, scene);
  let opened = '';
  studio.selected.watch((model) => {
    void scene.open(model);
    const key = model ? `${model.id}:${model.state === 'importing' || model.state === 'failed'}` : '';
    if (key === opened) return;
    opened = key;
    void points.open(model);
  });
  points.onReview = ({ vertex, position }) => scene.flyTo([position], vertex === null ? [] : [vertex]);
  points.positionOf = (vertex) => scene.preview?.positionOf(vertex)?.toArray() ?? null;

  scene.state.watch((state) => {
    const model = studio.selected.value;
    if (state.kind !== 'ready' || !model || thumbnails.has(model.id)) return;
    requestAnimationFrame(() => {
      thumbnails.set(model.id, scene.stage.thumbnail(112));
      shelf.draw();
    });
  });

  setInterval(() => livePanel.refreshFigures(scene.performer.value?.player ?? null), 500);
  setInterval(() => {
    performance.tick();
    clip.tick();
  }, 200);
  setInterval(() => {
    if (studio.tab.value !== 'live' || document.visibilityState !== 'visible') return;
    void live.refresh();
    if (recordings.running.length === 0) void recordings.refresh();
  }, 3000);
  setInterval(() => {
    if (recordings.running.length > 0 && studio.tab.value === 'live') void recordings.refresh();
  }, 1000);
  studio.tab.watch((tab) => {
    if (tab !== 'live') return;
    void live.refresh();
    void recordings.refresh();
  });

  void studio.start().then(() => {
    if (studio.selected.value?.state === 'parametrized') live.subscribe(demo.id, demo.title);
  });
  exposeInspection(scene, studio);
}

let compiledKernel: Promise<WebAssembly.Module> | null = null;

/** The WebAssembly kernel, fetched and compiled once. */
function kernelModule(): Promise<WebAssembly.Module> {
  compiledKernel ??= compileKernel(fetch('./kernel.wasm'));
  compiledKernel.catch(() => (compiledKernel = null));
  return compiledKernel;
}

const root = document.querySelector<HTMLElement>('#studio');
try {
  if (root) main(root);
} catch (error) {
  root?.replaceChildren(
    h(
      'div',
      { class: 'no-stage', role: 'alert' },
      h('h1', {}, 'Semblante'),
      h('p', {}, error instanceof Error ? error.message : String(error)),
    ),
  );
}

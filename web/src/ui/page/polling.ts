import type { ClipPanel } from '../animate/clip_panel.ts';
import type { LiveModel } from '../live/live_model.ts';
import type { LiveOverlay } from '../live/live_overlay.ts';
import type { LivePanel } from '../live/live_panel.ts';
import type { PerformancePanel } from '../live/performance_panel.ts';
import type { RecordingsModel } from '../recordings/recordings_model.ts';
import type { SceneView } from '../stage/scene.ts';
import type { Studio } from '../shared/studio.ts';

export interface PolledParts {
  studio: Studio;
  scene: SceneView;
  live: LiveModel;
  livePanel: LivePanel;
  overlay: LiveOverlay;
  recordings: RecordingsModel;
  performance: PerformancePanel;
  clip: ClipPanel;
}

/** Updates the displays that change with time, and polls heads, streams while the Live tab is open or one may end with the page, and recordings in that tab. */
export function startPolling({ studio, scene, live, livePanel, overlay, recordings, performance, clip }: PolledParts): void {
  setInterval(() => {
    const player = scene.performer.value?.player ?? null;
    livePanel.refreshFigures(player);
    overlay.tick(player?.stats ?? null);
  }, 500);
  setInterval(() => {
    performance.tick();
    clip.tick();
  }, 200);
  setInterval(() => {
    if (document.visibilityState !== 'visible') return;
    const isOpen = studio.tab.value === 'live';
    if (isOpen || live.hasMade) void live.refresh();
    if (!isOpen) return;
    if (recordings.running.length === 0) void recordings.refresh();
  }, 3000);
  setInterval(() => {
    if (recordings.running.length > 0 && studio.tab.value === 'live') void recordings.refresh();
  }, 1000);
  const updateHeads = (): void => {
    if (document.visibilityState === 'visible' && navigator.onLine && studio.shelf.value.kind === 'ready') void studio.update();
  };
  setInterval(updateHeads, 5000);
  document.addEventListener('visibilitychange', updateHeads);
  studio.tab.watch((tab) => {
    if (tab !== 'live') return;
    void live.refresh();
    void recordings.refresh();
  });
}

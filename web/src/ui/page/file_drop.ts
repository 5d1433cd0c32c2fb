import type { PathFile } from '../../net/head_files.ts';
import type { ClipPanel } from '../animate/clip_panel.ts';
import { dropPlace, kindOfFile, type DropPlace } from './drop_place.ts';
import { droppedFiles } from './dropped_files.ts';
import type { PointsPanel } from '../points/points_panel.ts';
import type { PerformancePanel } from '../live/performance_panel.ts';
import type { Studio } from '../shared/studio.ts';
import type { SpeakPanel } from '../speak/speak_panel.ts';

export interface DropReceivers {
  studio: Studio;
  points: PointsPanel;
  performance: PerformancePanel;
  clip: ClipPanel;
  speak: SpeakPanel;
}

/** Routes files and folders dropped anywhere on the page to the panels that read them. Call it once. */
export function routeDrops(page: HTMLElement, { studio, points, performance, clip, speak }: DropReceivers): void {
  acceptDrops(page, async (files) => {
    const { value: tab } = studio.tab;
    const places = await Promise.all(files.map(async ({ file }) => dropPlace(await kindOfFile(file), tab)));
    const going = (place: DropPlace): PathFile[] => files.filter((_, i) => places[i] === place);
    const [set, script, file, sound] = (['points', 'stream', 'page', 'speech'] as const).map((place) => going(place).at(-1));
    const heads = going('heads');
    if (set) {
      studio.tab.set('points');
      void points.importFile(set.file);
    } else if (script) {
      studio.tab.set('live');
      void performance.takeFile(script.file).then(() => reveal(performance.element));
    } else if (file) {
      studio.tab.set('animate');
      void clip.takeFile(file.file).then(() => reveal(clip.element));
    } else if (sound) {
      studio.tab.set('animate');
      speak.takeRecording(sound.file);
    }
    void studio.upload(heads);
  });
  refuseOtherDrops();
}

/** Scrolls to what has received a file, and says there what it makes of it: both stand far down in their panels. */
const reveal = (receiver: HTMLElement): void => void requestAnimationFrame(() => receiver.scrollIntoView({ block: 'start' }));

/** What is dropped where nothing takes it, as on a dialog, stays outside: a browser would open it in place of the studio. */
function refuseOtherDrops(): void {
  const refuse = (event: DragEvent): void => {
    if (event.defaultPrevented || !event.dataTransfer) return;
    const isText = !event.dataTransfer.types.includes('Files');
    if (isText && event.target instanceof Element && event.target.closest('input, textarea, select')) return;
    event.preventDefault();
    event.dataTransfer.dropEffect = 'none';
  };
  window.addEventListener('dragover', refuse);
  window.addEventListener('drop', refuse);
}

function acceptDrops(page: HTMLElement, take: (files: PathFile[]) => Promise<void>): void {
  let depth = 0;
  const carriesFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes('Files') ?? false;
  const set = (value: number): void => {
    depth = Math.max(0, value);
    page.classList.toggle('dropping', depth > 0);
  };
  page.addEventListener('dragenter', (event) => {
    if (carriesFiles(event)) set(depth + 1);
  });
  page.addEventListener('dragleave', (event) => {
    if (carriesFiles(event)) set(depth - 1);
  });
  page.addEventListener('dragover', (event) => {
    if (carriesFiles(event)) event.preventDefault();
  });
  page.addEventListener('drop', (event) => {
    if (!carriesFiles(event)) return;
    event.preventDefault();
    set(0);
    if (event.dataTransfer) void droppedFiles(event.dataTransfer).then(take);
  });
}

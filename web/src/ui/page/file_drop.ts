import type { PathFile } from '../../net/head_files.ts';
import type { ClipPanel } from '../animate/clip_panel.ts';
import { dropPlace, type DropPlace } from './drop_place.ts';
import { droppedFiles } from './dropped_files.ts';
import type { PerformancePanel } from '../live/performance_panel.ts';
import type { Studio } from '../shared/studio.ts';
import type { SpeakPanel } from '../speak/speak_panel.ts';

/** Routes files and folders dropped anywhere on the page to the panels that read them. */
export function routeDrops(page: HTMLElement, studio: Studio, performance: PerformancePanel, clip: ClipPanel, speak: SpeakPanel): void {
  acceptDrops(page, (files) => {
    const going = (place: DropPlace): PathFile[] => files.filter(({ file }) => dropPlace(file.name, studio.tab.value) === place);
    const [script, file, sound, heads] = [going('stream').at(-1), going('page').at(-1), going('speech').at(-1), going('heads')];
    if (script) {
      studio.tab.set('live');
      void performance.takeFile(script.file);
    } else if (file) {
      studio.tab.set('animate');
      void clip.takeFile(file.file);
    } else if (sound) {
      studio.tab.set('animate');
      speak.takeRecording(sound.file);
    }
    void studio.upload(heads);
  });
}

function acceptDrops(page: HTMLElement, take: (files: PathFile[]) => void): void {
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

import type { HiddenParts } from '../points/hidden_parts.ts';
import { partName } from '../shared/names.ts';
import type { Studio } from '../shared/studio.ts';
import type { SceneView } from '../stage/scene.ts';
import { t } from '../../words/words.ts';

/**
 * Hides parts on the stage while the Points tab is open; elsewhere the whole head is seen. H hides what is under the mouse, or
 * under the cross when the head has the focus; with Shift it shows everything.
 */
export function hideParts(canvas: HTMLCanvasElement, scene: SceneView, studio: Studio, hidden: HiddenParts): void {
  const show = (): void => scene.hideParts(studio.tab.value === 'points' ? hidden.hidden.value : new Set());
  studio.tab.watch(show);
  hidden.hidden.watch(show);

  let mouse: { x: number; y: number } | null = null; // normalized device coordinates
  canvas.addEventListener('pointermove', (event) => {
    const box = canvas.getBoundingClientRect();
    const over = { x: ((event.clientX - box.left) / box.width) * 2 - 1, y: 1 - ((event.clientY - box.top) / box.height) * 2 };
    mouse = event.pointerType === 'mouse' ? over : null;
  });
  canvas.addEventListener('pointerleave', () => (mouse = null));
  document.addEventListener('keydown', (event) => {
    if (studio.tab.value !== 'points' || event.key.toLowerCase() !== 'h' || event.ctrlKey || event.metaKey || event.altKey) return;
    if ((event.target as Element).closest('dialog, textarea, select, input:not([type=range], [type=checkbox], [type=file])')) return;
    if (event.shiftKey) return hidden.showAll();
    const at = mouse ?? (document.activeElement === canvas ? { x: 0, y: 0 } : null);
    const pick = at && scene.preview?.pick(at.x, at.y, scene.stage.camera);
    const part = hidden.parts.find(({ index }) => index === pick?.part);
    if (!part) return;
    event.preventDefault();
    hidden.set([part.index], true);
    studio.toasts.say(t('{name} is hidden.', { name: partName(part) }), { label: t('Show'), act: () => hidden.set([part.index], false) });
  });
}

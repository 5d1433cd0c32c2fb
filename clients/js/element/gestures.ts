import type { OrbitCamera } from '../view/camera.ts';

/** Radians for a stroke across the whole element, and for an arrow key. */
const strokeTurn = 2.4;
const keyTurn = 0.15;

/** One finger turns the head, two change the distance. `turn`: calls what it is given with the camera, if there is one. */
export function turnByFingers(stage: HTMLElement, mayTurn: () => boolean, turn: (by: (camera: OrbitCamera) => void) => void): void {
  const fingers = new Map<number, { x: number; y: number }>();
  stage.addEventListener('pointerdown', (event) => {
    if (!mayTurn()) return;
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    stage.setPointerCapture(event.pointerId);
  });
  stage.addEventListener('pointermove', (event) => {
    const from = fingers.get(event.pointerId);
    if (!from) return;
    const to = { x: event.clientX, y: event.clientY };
    const size = Math.max(1, Math.min(stage.clientWidth, stage.clientHeight));
    const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
    const distance = ({ x, y }: { x: number; y: number }): number => Math.hypot(x - other!.x, y - other!.y);
    turn((camera) => {
      if (other) camera.zoom(distance(from) / Math.max(1, distance(to)));
      else camera.orbit(((from.x - to.x) / size) * strokeTurn, ((to.y - from.y) / size) * strokeTurn);
    });
    fingers.set(event.pointerId, to);
  });
  for (const name of ['pointerup', 'pointercancel', 'lostpointercapture'] as const)
    stage.addEventListener(name, (event) => fingers.delete(event.pointerId));
}

const turns: Partial<Record<string, readonly [number, number]>> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** What a key does to the camera; null: nothing. */
export function turnOfKey(key: string): ((camera: OrbitCamera) => void) | null {
  const by = turns[key];
  if (by) return (camera) => camera.orbit(by[0] * keyTurn, by[1] * keyTurn);
  return key === 'Home' ? (camera) => camera.reset() : null;
}

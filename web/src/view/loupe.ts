import { PerspectiveCamera, type Object3D } from 'three';
import type { Stage } from './stage.ts';

/** How much larger than in the picture. */
const magnification = 3;

/**
 * A square part of the picture, magnified, drawn into a canvas of its own. It is drawn by the stage's renderer into a corner of
 * the stage's canvas and copied from there, so call `draw` in a frame hook: the stage draws over the corner in the same frame.
 * Allocates nothing after the first frame.
 */
export class Loupe {
  readonly canvas = document.createElement('canvas');
  private readonly camera = new PerspectiveCamera();
  private readonly context = this.canvas.getContext('2d')!;

  constructor(private readonly stage: Stage) {}

  /** `x`, `y`: the place in the middle, CSS pixels of the picture. `size`: edge of the loupe, CSS pixels. `without`: not drawn. */
  draw(x: number, y: number, size: number, without: readonly Object3D[]): void {
    const { renderer, scene, camera: eye, canvas: from } = this.stage;
    const { camera, canvas, context } = this;
    const ratio = renderer.getPixelRatio();
    const [width, height] = [from.width / ratio, from.height / ratio];
    camera.position.copy(eye.position);
    camera.quaternion.copy(eye.quaternion);
    camera.fov = eye.fov;
    camera.aspect = eye.aspect;
    camera.near = eye.near;
    camera.far = eye.far;
    const seen = size / magnification;
    camera.setViewOffset(width, height, x - seen / 2, y - seen / 2, seen, seen);
    camera.updateMatrixWorld();

    for (const object of without) object.visible = false;
    const shadows = renderer.shadowMap.autoUpdate;
    renderer.shadowMap.autoUpdate = false; // those of the last frame
    renderer.setViewport(0, 0, size, size);
    renderer.setScissor(0, 0, size, size);
    renderer.setScissorTest(true);
    renderer.render(scene, camera);
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, width, height);
    renderer.shadowMap.autoUpdate = shadows;
    for (const object of without) object.visible = true;

    const edge = Math.round(size * ratio);
    if (canvas.width !== edge) canvas.width = canvas.height = edge;
    context.clearRect(0, 0, edge, edge);
    context.drawImage(from, 0, from.height - edge, edge, edge, 0, 0, edge, edge);
    this.stage.invalidate();
  }
}

import { PMREMGenerator, type Texture, type WebGLRenderer } from 'three';
import { RoomEnvironment } from 'three/addons/environments/RoomEnvironment.js';

/** Blur of the room as it is drawn, radians, and the distances that its camera sees. */
const blur = 0.04;
const near = 0.1;
const far = 100;

/**
 * three.js makes an environment map at least 256 pixels wide and takes 256 samples for each pixel: without a graphics card the first
 * picture waits four seconds for it. 32 pixels are enough to tell a lamp from a box; with fewer, three.js draws none.
 */
class SmallPmremGenerator extends PMREMGenerator {
  /** Overrides a method of three.js that its types do not know. */
  protected _setSize(size: number): void {
    (this as unknown as { _cubeSize: number })._cubeSize = size;
  }
}

/** The surroundings that light the head, for `Scene.environment`. `size`: of a side of the cube map, pixels, a power of two. */
export function drawRoom(renderer: WebGLRenderer, size: number): Texture {
  const generator = new SmallPmremGenerator(renderer);
  const room = new RoomEnvironment();
  const { texture } = generator.fromScene(room, blur, near, far, { size });
  room.dispose();
  generator.dispose();
  return texture;
}

import { CompressedCubeTexture, HalfFloatType, LinearFilter, LinearMipmapLinearFilter, LinearSRGBColorSpace, PMREMGenerator, RGBAFormat, type Texture, type WebGLRenderer } from 'three';
import { RoomEnvironment } from 'three/addons/environments/RoomEnvironment.js';

/** Blur of the room as it is drawn, radians, and the distances that its camera sees. */
const blur = 0.04;
const near = 0.1;
const far = 100;

/**
 * Edge length of the small surroundings, pixels. 32 are enough to tell a lamp from a box; with fewer, three.js draws none. Its rough levels
 * end at 8.
 */
export const smallRoom = 32;
const leastSize = 8;
/** 1 as a number of 16 bits. */
const opaque = 0x3c00;
/** ms; the head waits for its surroundings. */
const longestWait = 10_000;

/** three.js makes an environment map at least 256 pixels wide. */
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

/**
 * What `drawRoom` draws with `smallRoom` pixels, from a file: without a graphics card five programs and their 256 samples for each pixel take
 * more than a second. The file has the levels from the sharpest on, of each the six faces, of each pixel one number of 16 bits, as the
 * room has no colours. `tests/browser/first_load.test.ts` compares it with what three.js draws, and writes it.
 */
export async function loadRoom(): Promise<Texture> {
  const response = await fetch(new URL('./room_32.bin', import.meta.url), { signal: AbortSignal.timeout(longestWait) });
  if (!response.ok) throw new Error(`${response.url}: status ${response.status}`);
  const light = new Uint16Array(await response.arrayBuffer());
  const faces = Array.from({ length: 6 }, () => ({ width: smallRoom, height: smallRoom, mipmaps: [] as { data: Uint16Array; width: number; height: number }[] }));
  let at = 0;
  for (let size = smallRoom; size >= leastSize; size /= 2) {
    for (const face of faces) {
      const data = new Uint16Array(size * size * 4);
      for (let i = 0; i < data.length; i += 4) {
        data.fill(light[at]!, i, i + 3);
        data[i + 3] = opaque;
        at += 1;
      }
      face.mipmaps.push({ data, width: size, height: size });
    }
  }
  // Not compressed: the only kind of cube of which three.js takes each level from an array.
  const texture = new CompressedCubeTexture(faces as unknown as ConstructorParameters<typeof CompressedCubeTexture>[0], RGBAFormat as never, HalfFloatType);
  texture.colorSpace = LinearSRGBColorSpace;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.magFilter = LinearFilter;
  texture.isPMREMTexture = true;
  texture.needsUpdate = true;
  return texture;
}

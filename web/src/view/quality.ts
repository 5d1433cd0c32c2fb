/** What the graphics card is asked for. */
export interface Quality {
  antialias: boolean;
  shadows: boolean;
  /** Sheen and second highlight on skin. */
  richSkin: boolean;
  /** Edge of the reflected room's cube, pixels. */
  roomSize: number;
  maxPixelRatio: number;
}

const full: Quality = { antialias: true, shadows: true, richSkin: true, roomSize: 256, maxPixelRatio: 2 };
const light: Quality = { antialias: false, shadows: false, richSkin: false, roomSize: 64, maxPixelRatio: 1 };

/** Light where the browser draws without a graphics card; there every shaded pixel costs. Throws where WebGL 2 is missing. */
export function chooseQuality(): Quality {
  const context = document.createElement('canvas').getContext('webgl2');
  if (!context)
    throw new Error(
      'This browser gives no WebGL 2, which drawing a head needs. Turn on hardware acceleration, or try another browser.',
    );
  const facts = context.getExtension('WEBGL_debug_renderer_info');
  const name = facts ? String(context.getParameter(facts.UNMASKED_RENDERER_WEBGL)) : '';
  context.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name) ? light : full;
}

/** Watches the time between drawn frames; tells once when a device does not keep up. */
export class PaceWatch {
  private slow = 0;

  /** Call after each frame that moves. Returns true when it is time to ask for less. */
  tick(deltaSeconds: number): boolean {
    // A tab that comes back has one long frame: that is not the device's fault.
    if (deltaSeconds > 0.09) return false;
    this.slow = Math.max(0, this.slow + (deltaSeconds > 1 / 28 ? 1 : -1));
    if (this.slow < 45) return false;
    this.slow = 0;
    return true;
  }
}

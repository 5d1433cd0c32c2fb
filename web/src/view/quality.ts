import { t } from '../words/words.ts';

/** Render settings for the graphics card. */
export interface Quality {
  antialias: boolean;
  shadows: boolean;
  /** Whether skin has sheen and a second highlight. */
  richSkin: boolean;
  /** Edge length of the environment cube map, pixels. */
  roomSize: number;
  maxPixelRatio: number;
}

const full: Quality = { antialias: true, shadows: true, richSkin: true, roomSize: 256, maxPixelRatio: 2 };
const light: Quality = { antialias: false, shadows: false, richSkin: false, roomSize: 64, maxPixelRatio: 1 };

/** Lower quality for software renderers, where every shaded pixel is slow. Throws where WebGL 2 is missing. */
export function chooseQuality(): Quality {
  const context = document.createElement('canvas').getContext('webgl2');
  if (!context)
    throw new Error(
      t('This browser has no WebGL 2, which the studio needs. Enable hardware acceleration, or try another browser.'),
    );
  const facts = context.getExtension('WEBGL_debug_renderer_info');
  const name = facts ? String(context.getParameter(facts.UNMASKED_RENDERER_WEBGL)) : '';
  context.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name) ? light : full;
}

/** Detects, from the time between drawn frames, a device that is too slow for the current settings. */
export class PaceWatch {
  private slow = 0;

  /** To call after each animated frame. Returns true when the quality should be lowered. */
  tick(deltaSeconds: number): boolean {
    // A long frame comes from a hidden tab that became visible, not from a slow device.
    if (deltaSeconds > 0.09) return false;
    this.slow = Math.max(0, this.slow + (deltaSeconds > 1 / 28 ? 1 : -1));
    if (this.slow < 45) return false;
    this.slow = 0;
    return true;
  }
}

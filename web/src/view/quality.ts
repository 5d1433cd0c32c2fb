import { coarse } from '@client/view/pace.ts';
import { t } from '../words/words.ts';
import { smallRoom } from './room.ts';

/** Render settings for the graphics card. */
export interface Quality {
  antialias: boolean;
  shadows: boolean;
  /** Whether skin has sheen and a second highlight. */
  richSkin: boolean;
  /** Edge length of the environment cube map, pixels; `smallRoom`: it comes from a file. */
  roomSize: number;
  /** Drawn pixels for each pixel of the page, along a side: of a still picture. */
  maxPixelRatio: number;
  /** The same while it moves, on a device that keeps its pace so. */
  movingPixelRatio: number;
}

const full: Quality = { antialias: true, shadows: true, richSkin: true, roomSize: 256, maxPixelRatio: 2, movingPixelRatio: 2 };
const light: Quality = { antialias: false, shadows: false, richSkin: false, roomSize: smallRoom, maxPixelRatio: 1, movingPixelRatio: coarse };

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

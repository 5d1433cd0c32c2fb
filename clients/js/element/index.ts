import { SemblanteFace } from './semblante_face.ts';

export type { Fit } from '../view/framing.ts';
export type { FaceAttributes } from './attributes.ts';
export type { QualityName } from './detail.ts';
export { SemblanteFace, type Connection, type FaceEventMap, type FaceState } from './semblante_face.ts';
export { faceWords, type FaceWords, type Trouble } from './words.ts';

export const elementName = 'semblante-face';

// Importing this module defines the element; twice, from two copies, does no harm.
if (typeof customElements !== 'undefined' && !customElements.get(elementName)) customElements.define(elementName, SemblanteFace);

declare global {
  interface HTMLElementTagNameMap {
    'semblante-face': SemblanteFace;
  }
}

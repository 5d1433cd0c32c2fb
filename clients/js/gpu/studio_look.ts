/**
 * How a face looks in the studio, as numbers: light, camera and skin. Every renderer of ours uses them. Places of lights
 * are relative to the centre of what is shown, in its radius; colours are sRGB.
 */
export const studioLight = {
  hemisphere: { sky: 0xffffff, ground: 0x6b5a4e, intensity: 0.35 },
  key: { color: 0xfff1e2, intensity: 2.1, place: [-1.6, 1.9, 2.8] },
  rim: { color: 0xdfe6ff, intensity: 0.9, place: [2.4, 1.2, -2.2] },
  /** share of the room that surrounds the head */
  environment: 0.42,
  shadow: { size: 1024, softness: 7, intensity: 0.75, bias: 0.0006, normalBias: 0.012, near: 0.5, far: 7, reach: 1.3 },
} as const;

/** vertical, degrees */
export const fieldOfView = 26;

/** Of materials that are plain white and have no texture. */
export const bareSkinColor = 0xd8a387;
/** A component above this is white. */
export const whiteLevel = 0.94;
export const mostMetalness = 0.4;

/** Sheen and a weaker highlight approximate the light that skin scatters below its surface. */
export const skinLook = {
  roughness: { least: 0.45, most: 0.62 },
  sheen: 0.35,
  sheenRoughness: 0.55,
  sheenColor: 0xff9d7a,
  specularIntensity: 0.65,
} as const;

/** Smoother materials are wet or polished. */
const smoothest = 0.25;

/** Whether a material gets the look of skin: by roughness, transparency and name. */
export function isSkinLike(name: string, roughness: number, transparent: boolean): boolean {
  if (roughness < smoothest || transparent) return false;
  return !/eye|iris|cornea|sclera|teeth|tooth|tongue|lash|brow|hair|fluid/.test(name.toLowerCase());
}

export function skinRoughness(roughness: number): number {
  return Math.min(Math.max(roughness, skinLook.roughness.least), skinLook.roughness.most);
}

/** Lashes and brows are transparent and unsorted: pixels below this opacity leave no edges. */
export const leastOpacity = 0.02;
/**
 * From this opacity on a transparent material counts as solid: what is solid is drawn first and hides what lies behind
 * it, because layers of hair are unsorted too.
 */
export const solidOpacity = 0.9;

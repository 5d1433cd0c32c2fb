/** Colours of the influence view, legible for colour-blind people on light and dark pages. sRGB, 0..255. */
export type Rgb = readonly [number, number, number];

/** Viridis at equal steps from 0 to 1: brightness rises evenly, so that it reads without hue. */
export const heatStops: readonly Rgb[] = [
  [68, 1, 84],
  [71, 45, 123],
  [59, 82, 139],
  [44, 114, 142],
  [33, 145, 140],
  [40, 174, 128],
  [94, 201, 98],
  [173, 220, 48],
  [253, 231, 37],
];

/** The colours of Okabe and Ito, which differ for every kind of colour vision. */
export const regionColours: readonly Rgb[] = [
  [230, 159, 0],
  [86, 180, 233],
  [0, 158, 115],
  [240, 228, 66],
  [0, 114, 178],
  [213, 94, 0],
  [204, 121, 167],
];

/** What the shown points do not reach. */
export const restColour: Rgb = [186, 181, 176];
/** Skin that follows points by at least `littleWeight`. */
export const coveredColour: Rgb = [158, 180, 196];
export const littleColour: Rgb = [240, 228, 66];
export const uncoveredColour: Rgb = [213, 94, 0];

/** The colour of a weight, 0..1. */
export function heatColour(weight: number): Rgb {
  const last = heatStops.length - 1;
  const at = Math.min(Math.max(weight, 0), 1) * last;
  const low = Math.min(Math.floor(at), last - 1);
  const mix = (k: 0 | 1 | 2): number => heatStops[low]![k] + (heatStops[low + 1]![k] - heatStops[low]![k]) * (at - low);
  return [mix(0), mix(1), mix(2)];
}

export const cssColour = ([r, g, b]: Rgb): string => `rgb(${Math.round(r)} ${Math.round(g)} ${Math.round(b)})`;

/** The scale of weights from 0 at the start to 1 at the end. */
export const heatGradient = (direction: 'to top' | 'to right'): string =>
  `linear-gradient(${direction}, ${heatStops.map(cssColour).join(', ')})`;

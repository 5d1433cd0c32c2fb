/** The standard's names as readable titles. */

const words: Record<string, string> = {
  l: 'left',
  r: 'right',
  t: 'upper',
  b: 'lower',
  lm: 'left of middle',
  rm: 'right of middle',
  i: 'inner',
  m: 'middle',
  o: 'outer',
};
const joined: Record<string, string> = { midlip: 'lip middle', cornerlip: 'lip corner', cornerlips: 'lip corners' };

/** "stretch_l_cornerlip_o" -> "Stretch left lip corner"; the title of the group names the outer contour. */
export function fapTitle(name: string, group: number): string {
  const parts = name.split('_').filter((part, i, all) => !(part === 'o' && group === 8 && i === all.length - 1));
  const text = parts.map((part) => words[part] ?? joined[part] ?? part).join(' ');
  return capital(text);
}

export const fapGroupTitles: Record<number, string> = {
  2: 'Jaw and inner lips',
  3: 'Eyes',
  4: 'Eyebrows',
  5: 'Cheeks',
  6: 'Tongue',
  7: 'Head',
  8: 'Outer lips',
  9: 'Nose',
  10: 'Ears',
};

export const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

export const roleTitles: Record<string, string> = {
  skin: 'Skin',
  left_eye: 'Left eye',
  right_eye: 'Right eye',
  upper_teeth: 'Upper teeth',
  lower_teeth: 'Lower teeth',
  tongue: 'Tongue',
  attached: 'Attached',
  rest: 'Rest',
  body: 'Body',
};

export const stageTitles: Record<string, string> = {
  read: 'Reading the file',
  import: 'Reading the file',
  surface: 'Joining seams',
  proposals: 'Proposing points',
  report: 'Checking the fit',
  distances: 'Measuring distances',
  regions: 'Finding regions',
  weights: 'Computing weights',
  encode: 'Packing the face',
  package: 'Packing the face',
  store: 'Saving',
};

export const stageTitle = (stage: string): string => stageTitles[stage] ?? capital(stage.replaceAll(/[_-]/g, ' '));

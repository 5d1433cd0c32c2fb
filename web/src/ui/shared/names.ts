import { nameOf, serverWords, t } from '../../words/words.ts';

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

/** "stretch_l_cornerlip_o" -> "Stretch left lip corner", in the language of the page; the title of the group names the outer contour. */
export function fapTitle(name: string, group: number): string {
  const parts = name.split('_').filter((part, i, all) => !(part === 'o' && group === 8 && i === all.length - 1));
  const text = parts.map((part) => words[part] ?? joined[part] ?? part).join(' ');
  return nameOf(capital(text));
}

export const fapGroupTitles: Record<number, string> = {
  2: t('Jaw and inner lips'),
  3: t('Eyes'),
  4: t('Eyebrows'),
  5: t('Cheeks'),
  6: t('Tongue'),
  7: t('Head'),
  8: t('Outer lips'),
  9: t('Nose'),
  10: t('Ears'),
};

export const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

export const roleTitles: Record<string, string> = {
  skin: t('Skin'),
  left_eye: t('Left eye'),
  right_eye: t('Right eye'),
  upper_teeth: t('Upper teeth'),
  lower_teeth: t('Lower teeth'),
  tongue: t('Tongue'),
  attached: t('Attached'),
  rest: t('Rest'),
  body: t('Body'),
};

export const partName = ({ name, index }: { name: string; index: number }): string => (name === '' ? t('Part {index}', { index }) : name);

export const stageTitles: Record<string, string> = {
  read: t('Reading the file'),
  import: t('Reading the file'),
  surface: t('Joining seams'),
  proposals: t('Proposing points'),
  report: t('Checking the fit'),
  distances: t('Measuring distances'),
  regions: t('Finding regions'),
  weights: t('Computing weights'),
  encode: t('Packing the face'),
  package: t('Packing the face'),
  store: t('Saving'),
};

export const stageTitle = (stage: string): string => stageTitles[stage] ?? capital(serverWords(stage).replaceAll(/[_-]/g, ' '));

import type { Model } from '../../net/types.ts';

/** From this number of heads on the list has a search. */
export const searchedHeads = 10;

/** From this number of heads on the list takes the height of what stands below it, in a low window and in another. */
export const manyHeads = (isLow: boolean): number => (isLow ? 4 : 7);

/** The heads of the list: the newest first, so that what one has just added stands where one looks, and only those with these words in their names. */
export function listed(heads: readonly Model[], words: string): Model[] {
  const wanted = plain(words).split(/\s+/).filter((word) => word !== '');
  return heads
    .filter(({ name }) => wanted.every((word) => plain(name).includes(word)))
    .sort((a, b) => (a.created < b.created ? 1 : a.created > b.created ? -1 : 0));
}

/** Without case and accents. */
const plain = (text: string): string => text.normalize('NFD').replaceAll(/\p{M}/gu, '').toLowerCase().trim();

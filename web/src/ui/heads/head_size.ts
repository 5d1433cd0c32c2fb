import type { Model } from '../../net/types.ts';
import { formatBytes, formatCount } from '../shared/format.ts';
import { t } from '../../words/words.ts';

/** The size of a head for display: number of vertices or, before the import has counted them, bytes of the file. */
export const headSize = ({ counts, source }: Model): string =>
  counts.vertices > 0 ? t('{vertices} vertices', { vertices: formatCount(counts.vertices) }) : formatBytes(source.bytes);

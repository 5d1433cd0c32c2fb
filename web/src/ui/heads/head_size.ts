import type { Model } from '../../net/types.ts';
import { formatBytes, formatCount } from '../shared/format.ts';

/** How large a head is: its vertices, or the bytes of its file as long as they have not been counted. */
export const headSize = ({ counts, source }: Model): string =>
  counts.vertices > 0 ? `${formatCount(counts.vertices)} vertices` : formatBytes(source.bytes);

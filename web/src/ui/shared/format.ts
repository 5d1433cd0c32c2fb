import { language } from '../../words/words.ts';

/** 1234567 -> "1.2 MB"; decimal units, as file managers show them. */
export function formatBytes(bytes: number): string {
  if (bytes < 1000) return `${Math.round(bytes)} B`;
  const units = ['kB', 'MB', 'GB'] as const;
  let value = bytes / 1000;
  let unit = 0;
  while (value >= 999.5 && unit < units.length - 1) {
    value /= 1000;
    unit += 1;
  }
  return `${value < 9.95 ? value.toLocaleString(language, { minimumFractionDigits: 1, maximumFractionDigits: 1 }) : Math.round(value)} ${units[unit]}`;
}

/** Long numbers of bytes in a sentence of the server, as people read them. */
export const withShortSizes = (text: string): string => text.replaceAll(/\b(\d{5,}) bytes\b/g, (_, bytes: string) => formatBytes(Number(bytes)));

export function formatCount(count: number): string {
  return count.toLocaleString(language);
}

/** A number with at most so many significant digits and the language's decimal sign. */
export function formatNumber(value: number, digits: number): string {
  return value.toLocaleString(language, { maximumSignificantDigits: digits, useGrouping: false });
}

/** 0.25 -> "25%". */
export function formatPercent(share: number): string {
  return share.toLocaleString(language, { style: 'percent' });
}

/** 83400 ms -> "1:23.4". */
export function formatTime(ms: number): string {
  const tenths = Math.max(0, Math.floor(ms / 100));
  const minutes = Math.floor(tenths / 600);
  const tenth = { minimumIntegerDigits: 2, minimumFractionDigits: 1, maximumFractionDigits: 1 };
  return `${minutes}:${((tenths % 600) / 10).toLocaleString(language, tenth)}`;
}

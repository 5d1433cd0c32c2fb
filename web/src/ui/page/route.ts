import type { Tab } from '../shared/studio.ts';

/** What the page's address names, after the `#`: `head/tab?point=8.1&stream=id`. Every part can be absent. */
export interface Route {
  head: string | null;
  tab: Tab | null;
  point: string | null;
  stream: string | null;
}

export const tabNames: readonly Tab[] = ['heads', 'fit', 'points', 'animate', 'live'];

/** The route of an address; what it does not understand is absent. */
export function parseRoute(hash: string): Route {
  const text = hash.replace(/^#/, '');
  const mark = text.indexOf('?');
  const [head = '', tab = ''] = (mark < 0 ? text : text.slice(0, mark)).split('/');
  const query = new URLSearchParams(mark < 0 ? '' : text.slice(mark + 1));
  return {
    head: decoded(head) || null,
    tab: tabNames.find((name) => name === tab) ?? null,
    point: query.get('point') || null,
    stream: query.get('stream') || null,
  };
}

export function formatRoute({ head, tab, point, stream }: Route): string {
  const query = new URLSearchParams();
  if (point !== null) query.set('point', point);
  if (stream !== null) query.set('stream', stream);
  const place = [head === null ? '' : encodeURIComponent(head), ...(tab === null ? [] : [tab])].join('/');
  return `#${place}${query.size > 0 ? `?${query.toString()}` : ''}`;
}

/** Whether the way from one to the other is a step that Back takes back: choosing another point is not. */
export const isStep = (from: Route, to: Route): boolean =>
  from.head !== to.head || from.tab !== to.tab || from.stream !== to.stream;

function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return '';
  }
}

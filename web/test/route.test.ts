import { expect, test } from 'vitest';
import { formatRoute, isStep, parseRoute, type Route } from '../src/ui/page/route.ts';

const none: Route = { head: null, tab: null, point: null, stream: null };

test('Route_AnyRoute_ComesBackFromItsAddress', () => {
  const routes: Route[] = [
    none,
    { ...none, head: 'sample' },
    { ...none, head: 'a b/ç?#&', tab: 'points', point: '8.1' },
    { head: 'x', tab: 'live', point: null, stream: 's=1&t' },
  ];
  for (const route of routes) expect(parseRoute(formatRoute(route))).toEqual(route);
});

test('Route_AddressOfAHeadAlone_NamesThatHead', () =>
  expect(parseRoute('#01J%20x')).toEqual({ ...none, head: '01J x' }));

test('Route_UnknownParts_AreAbsent', () => {
  for (const hash of ['', '#', '#/', '#//', '#%E0%A4%A/nothing?point=&x=1']) expect(parseRoute(hash)).toEqual(none);
});

test('Route_AnotherPoint_IsNoStep', () => {
  const from: Route = { head: 'a', tab: 'points', point: '2.1', stream: null };
  expect(isStep(from, { ...from, point: '8.1' })).toBe(false);
  for (const change of [{ head: 'b' }, { tab: 'live' as const }, { stream: 's' }])
    expect(isStep(from, { ...from, ...change })).toBe(true);
});

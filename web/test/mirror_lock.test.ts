import { expect, test } from 'vitest';
import { MirrorLock } from '../src/ui/points/mirror_lock.ts';
import { SettingsStore } from '../src/ui/points/settings_store.ts';
import { Signal } from '../src/ui/shared/signal.ts';
import type { Studio } from '../src/ui/shared/studio.ts';
import type { Model } from '../src/net/types.ts';
import { memory } from './support/memory.ts';
import { importingModel } from './support/models.ts';

test('Lock_OfAHead_LinksPairsButThoseTakenApart_AndIsRemembered', () => {
  const store = new SettingsStore(memory());
  const selected = new Signal<Model | null>(importingModel({ id: 'a' }));
  const lock = new MirrorLock({ selected } as unknown as Studio, store);
  expect(lock.twinOf('8.3')).toBeNull();
  lock.lock(true);
  lock.link('8.4', false);
  expect([lock.twinOf('8.3'), lock.twinOf('8.4'), lock.twinOf('8.5'), lock.twinOf('2.1')]).toEqual([null, null, '8.6', null]);
  selected.set(importingModel({ id: 'b' }));
  expect(lock.twinOf('8.5')).toBeNull();
  selected.set(importingModel({ id: 'a' }));
  expect([lock.twinOf('8.3'), lock.twinOf('8.5')]).toEqual([null, '8.6']);
  lock.link('8.3', true);
  expect(lock.twinOf('8.4')).toBe('8.3');
});

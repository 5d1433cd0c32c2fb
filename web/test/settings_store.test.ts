import { describe, expect, test } from 'vitest';
import { SettingsStore } from '../src/ui/points/settings_store.ts';
import { memory } from './support/memory.ts';

describe('settings of the Points tab', () => {
  test('Settings_OfTwoHeads_AreKeptApartAndForgotten', () => {
    const storage = memory();
    const store = new SettingsStore(storage);
    store.keep('a', { hidden: [3, 5] });
    store.keep('b', { hidden: [1] });
    expect(new SettingsStore(storage).read('a')).toEqual({ hidden: [3, 5] });
    store.forget('a');
    expect(store.read('a')).toEqual({ hidden: [] });
    store.keep('b', { hidden: [] });
    expect(storage.length).toBe(0);
  });

  test('Settings_OfStrangeContentOrWithoutStorage_AreThoseOfANewHead', () => {
    for (const content of ['', 'x', '3', 'null', '[]', '{"hidden":7}', '{"hidden":["a",-1,0.5,null]}']) {
      const store = new SettingsStore(memory({ 'semblante.points.a': content }));
      expect(store.read('a'), content).toEqual({ hidden: [] });
    }
    const store = new SettingsStore(null);
    store.keep('a', { hidden: [1] });
    expect(store.read('a')).toEqual({ hidden: [] });
  });
});

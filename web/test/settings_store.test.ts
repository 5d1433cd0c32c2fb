import { describe, expect, test } from 'vitest';
import { SettingsStore } from '../src/ui/points/settings_store.ts';
import { memory } from './support/memory.ts';

const none = { hidden: [], locked: false, apart: [] };

describe('settings of the Points tab', () => {
  test('Settings_OfTwoHeads_AreKeptApartAndForgotten', () => {
    const storage = memory();
    const store = new SettingsStore(storage);
    store.change('a', { hidden: [3, 5] });
    store.change('a', { locked: true });
    store.change('a', { apart: ['8.3'] });
    store.change('b', { hidden: [1] });
    expect(new SettingsStore(storage).read('a')).toEqual({ hidden: [3, 5], locked: true, apart: ['8.3'] });
    store.forget('a');
    expect(store.read('a')).toEqual(none);
    store.change('b', { hidden: [] });
    expect(storage.length).toBe(0);
  });

  test('Settings_OfStrangeContentOrWithoutStorage_AreThoseOfANewHead', () => {
    for (const content of ['', 'x', '3', 'null', '[]', '{"hidden":7}', '{"hidden":["a",-1,0.5,null],"locked":1,"apart":["12.1",3]}']) {
      const store = new SettingsStore(memory({ 'semblante.points.a': content }));
      expect(store.read('a'), content).toEqual(none);
    }
    const store = new SettingsStore(null);
    store.change('a', { hidden: [1] });
    expect(store.read('a')).toEqual(none);
  });
});

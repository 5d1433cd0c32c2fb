/**
 * Whether tests that go the same way in several looks, languages or with several hands do so in each (`tests/run --browser`);
 * else in a few that have each of them once: a page costs seconds without a graphics card.
 */
export const everyVariant = process.env['SEMBLANTE_BROWSER_TESTS'] === 'all';

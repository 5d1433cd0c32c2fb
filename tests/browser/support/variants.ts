/**
 * Whether a test runs in every combination of look, language and way of input (`tests/run --browser`), or only in a few that
 * have each of them once: a page costs seconds without a graphics card.
 */
export const everyVariant = process.env['SEMBLANTE_BROWSER_TESTS'] === 'all';

/** The header that a service worker gives an answer which it had kept, because the server gave none. */
export const keptHeader = 'Semblante-Kept';

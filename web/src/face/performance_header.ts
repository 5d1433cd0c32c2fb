/** What every performance document begins with (protocol/performance). */
export const performanceHeader = { format: 'semblante.performance', version: 1 } as const;

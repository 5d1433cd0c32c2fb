/** The project's own performance documents, loaded when chosen. */
export const examples: readonly { title: string; text: () => Promise<string> }[] = [
  {
    title: 'Hello: a greeting with a nod and a wink',
    text: async () => (await import('../../../protocol/examples/performances/hello.json?raw')).default,
  },
  {
    title: 'A minute: talks, looks about, feels',
    text: async () => (await import('../../../protocol/examples/performances/minute.json?raw')).default,
  },
];

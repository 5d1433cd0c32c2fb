import { t } from '../../words/words.ts';

/** The project's example performance documents, loaded on demand. */
export const examples: readonly { name: string; title: string; text: () => Promise<string> }[] = [
  {
    name: 'hello.json',
    title: t('Hello: a greeting with a nod and a wink'),
    text: async () => (await import('../../../../protocol/examples/performances/hello.json?raw')).default,
  },
  {
    name: 'minute.json',
    title: t('A minute: talks, looks about, feels'),
    text: async () => (await import('../../../../protocol/examples/performances/minute.json?raw')).default,
  },
];

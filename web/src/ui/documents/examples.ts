import { t } from '../../words/words.ts';

/** An example performance document of the project, loaded on demand. */
export interface Example {
  name: string;
  title: string;
  text: () => Promise<string>;
}

/** The one that shows most of what a face can do. */
export const bestExample: Example = {
  name: 'minute.json',
  title: t('A minute: talks, looks about, feels'),
  text: async () => (await import('../../../../protocol/examples/performances/minute.json?raw')).default,
};

export const examples: readonly Example[] = [
  {
    name: 'hello.json',
    title: t('Hello: a greeting with a nod and a wink'),
    text: async () => (await import('../../../../protocol/examples/performances/hello.json?raw')).default,
  },
  bestExample,
];

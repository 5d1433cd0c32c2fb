import type { VoiceName } from '../../net/types.ts';

/** The voices of a language: of "en" those of all its countries, of "pt-BR" its own and those of no country. */
export function voicesOf(voices: readonly VoiceName[], tag: string): VoiceName[] {
  const [primary] = tag.split('-');
  return voices.filter(({ language }) =>
    tag === primary ? language.split('-')[0] === primary : language === tag || language === primary,
  );
}

export const languages = { en: 'English', 'pt-BR': 'Português' } as const;
export type Language = keyof typeof languages;

/** Where the browser keeps a language that was chosen by hand, for the studio and the page of one face. */
const key = 'semblante.language';

/** The first language of a browser's list that there are texts in, else English. */
export function languageOf(wanted: readonly string[]): Language {
  for (const name of wanted) {
    if (/^pt\b/i.test(name)) return 'pt-BR';
    if (/^en\b/i.test(name)) return 'en';
  }
  return 'en';
}

function chosenLanguage(): Language | null {
  try {
    const kept = globalThis.localStorage?.getItem(key) ?? '';
    return kept in languages ? (kept as Language) : null;
  } catch {
    return null;
  }
}

/** The language of the page, for texts, numbers and dates; it changes only with the page. */
export const language: Language = chosenLanguage() ?? languageOf(globalThis.navigator?.languages ?? []);

/** Stores a language for this browser and opens the page again in it. */
export function changeLanguage(to: Language): void {
  try {
    localStorage.setItem(key, to);
  } catch {
    return; // storage is forbidden, and the page would forget the choice
  }
  location.reload();
}

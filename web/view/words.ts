import type { Connection, FaceWords } from 'semblante/element';
import { language } from '../kept/language.ts';

/** The words of the page around the face. */
export interface PageWords {
  noStream: string;
  captions: string;
  play: string;
  pause: string;
  connection: Record<Connection, string>;
}

/** A language of the page: its own words, and those of the face. */
export interface ViewWords {
  page: PageWords;
  face: FaceWords | null;
}

const english: ViewWords = {
  page: {
    noStream: 'No stream is named: the address of this page ends with the name of a stream, as in /view/demo.',
    captions: 'Captions',
    play: 'Play',
    pause: 'Pause',
    connection: { none: '', good: 'Good connection', fair: 'Slow connection', poor: 'Poor connection', lost: 'No connection' },
  },
  face: null, // as it comes
};

/** The words in the language of the page. Another language than English is loaded when it is needed. */
export async function viewWords(): Promise<ViewWords> {
  if (language === 'en') return english;
  return import('./portuguese.ts').then(
    ({ portuguese }) => portuguese,
    () => english, // the page shows its face also where this file is missing
  );
}

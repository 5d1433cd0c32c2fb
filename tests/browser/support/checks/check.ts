import type { StudioPage } from '../studio_page.ts';
import type { Look } from '../looks.ts';

/** Something that holds on each screen of the studio. */
export interface Check {
  /** What holds; a part of a test's name. */
  name: string;
  /** The looks in which it is asked; without it all. */
  isFor?: (look: Look) => boolean;
  /** What is wrong with the screen that a page shows now. */
  faults: (studio: StudioPage) => Promise<string[]>;
}

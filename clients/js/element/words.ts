/** What can keep a face from being shown or moving, and how the page says it. */
export type Trouble =
  | 'address'
  | 'no-stream'
  | 'no-model'
  | 'model-unready'
  | 'private'
  | 'unreachable'
  | 'library'
  | 'policy'
  | 'server'
  | 'damaged'
  | 'no-webgl'
  | 'ended'
  | 'lost';

export class FaceTrouble extends Error {
  constructor(
    readonly code: Trouble,
    message: string,
  ) {
    super(message);
    this.name = 'FaceTrouble';
  }
}

/** All that a face says on the page. */
export interface FaceWords {
  play: string;
  soundOn: string;
  soundOff: string;
  noSound: string;
  voiceOn: string;
  voiceOff: string;
  /** The accessible name of a face without `alt`; `stream` may be empty. */
  face: (stream: string) => string;
  trouble: Record<Trouble, (name: string) => string>;
}

/** The words of all faces of the page. A page of another language replaces its members before it makes a face. */
export const faceWords: FaceWords = {
  play: 'Play',
  soundOn: 'Sound on',
  soundOff: 'Sound off',
  noSound: 'No sound in this browser',
  voiceOn: 'Voice on',
  voiceOff: 'Voice off',
  face: (stream) => `Animated face${stream && `, stream ${stream}`}`,
  trouble: {
    address: (name) => `“${name}” is not the address of a server. It begins with https:// or http://, or is a path on the server of this page.`,
    'no-stream': (name) => `There is no stream “${name}” on this server.`,
    'no-model': (name) => `The stream “${name}” has no face yet. It is shown as soon as a model is chosen for it.`,
    'model-unready': () => 'There is no such face, or it is still being prepared.',
    private: () => 'This stream is private. Open it with the link of your invitation.',
    unreachable: () => 'The server cannot be reached. Trying again.',
    library: () => 'This page could not load the part of it that draws faces. Trying again.',
    policy: (name) => `The rules of this page forbid it to load from ${name}.`,
    server: () => 'The server has a problem. Trying again.',
    damaged: () => 'This face could not be loaded: its files do not fit together.',
    'no-webgl': () => 'This browser has no WebGL 2, which drawing a face needs. Turn on hardware acceleration, or use another browser.',
    ended: () => 'The stream has ended.',
    lost: () => 'The connection was lost. Trying again.',
  },
};

const lasting: ReadonlySet<Trouble> = new Set<Trouble>(['address', 'no-webgl', 'private', 'damaged', 'policy']);

/** Whether it can pass by itself, so that waiting helps. */
export const isPassing = (code: Trouble): boolean => !lasting.has(code);

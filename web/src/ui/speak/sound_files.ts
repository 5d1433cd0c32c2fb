/** Endings of sound files that the server may read; one without such an ending is chosen by the panel's button. */
export const soundEndings = ['.wav', '.flac', '.ogg', '.oga', '.opus', '.mp3'];

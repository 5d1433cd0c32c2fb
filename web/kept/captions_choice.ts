/** Where the browser keeps whether captions are shown, for the studio and the page of one face. */
const key = 'semblante.captions';

export function captionsAreChosen(): boolean {
  try {
    return localStorage.getItem(key) === 'on';
  } catch {
    return false; // a browser that keeps nothing
  }
}

export function chooseCaptions(on: boolean): void {
  try {
    localStorage.setItem(key, on ? 'on' : 'off');
  } catch {
    // It is forgotten with the page.
  }
}

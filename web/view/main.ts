import './view.css';
import { faceWords, SemblanteFace } from 'semblante/element';
import { acceptInvitation } from './invitation.ts';
import { keepOffline } from '../offline/register.ts';
import { captionsAreChosen, chooseCaptions } from '../kept/captions_choice.ts';
import { language } from '../kept/language.ts';
import { stayAwake } from './wake_lock.ts';
import { viewWords } from './words.ts';

/** "/view/demo", also below a path of a proxy: the server's address and the stream's id. */
export function placeOf(path: string): { base: string; stream: string } {
  const at = path.lastIndexOf('/view/');
  return { base: path.slice(0, Math.max(at, 0)), stream: decodeURIComponent(path.slice(at + '/view/'.length)) };
}

const paths = { pause: 'M6 4h4v16H6zM14 4h4v16h-4z', play: 'M7 4l13 8-13 8z' };

function svg(inside: string): SVGSVGElement {
  const picture = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  picture.setAttribute('viewBox', '0 0 24 24');
  picture.setAttribute('aria-hidden', 'true');
  picture.innerHTML = inside;
  return picture;
}

/** The page: one face, how its connection is, and buttons for captions and to pause it. */
async function main(root: HTMLElement): Promise<void> {
  const { base, stream } = placeOf(location.pathname);
  const { page, face: words } = await viewWords();
  document.documentElement.lang = language;
  if (words) Object.assign(faceWords, words);
  if (stream === '') {
    root.textContent = page.noStream;
    root.className = 'note';
    return;
  }
  document.title = `${stream} · Semblante`;
  await acceptInvitation(base);

  const face = new SemblanteFace();
  face.src = base === '' ? '' : location.origin + base;
  face.stream = stream;
  face.setAttribute('orbit', 'free');
  face.sound = true;
  // "?voice": this device's own voice, for the thinnest wire.
  face.voice = new URLSearchParams(location.search).has('voice');
  face.captions = captionsAreChosen();
  face.tabIndex = 0;

  const bars = document.createElement('span');
  bars.className = 'bars';
  bars.append(svg('<rect x="3" y="15" width="4" height="6" rx="1"/><rect x="10" y="10" width="4" height="11" rx="1"/><rect x="17" y="4" width="4" height="17" rx="1"/>'));
  const status = document.createElement('span');
  status.className = 'unseen';
  status.setAttribute('role', 'status');
  const button = document.createElement('button');
  button.type = 'button';
  button.hidden = true;
  button.addEventListener('click', () => (face.paused ? face.play() : face.pause()));
  const captions = document.createElement('button');
  captions.type = 'button';
  captions.title = page.captions;
  captions.setAttribute('aria-label', page.captions);
  captions.setAttribute('aria-pressed', String(face.captions));
  captions.append(svg('<path fill-rule="evenodd" d="M4 5h16a2 2 0 0 1 2 2v10a2 2 0 0 1-2 2H4a2 2 0 0 1-2-2V7a2 2 0 0 1 2-2zm1 6v2h4v-2zm6 0v2h8v-2zm-6 4v2h8v-2zm10 0v2h4v-2z"/>'));
  captions.addEventListener('click', () => {
    face.captions = !face.captions;
    captions.setAttribute('aria-pressed', String(face.captions));
    chooseCaptions(face.captions);
  });
  const corner = document.createElement('div');
  corner.className = 'corner';
  corner.hidden = true;
  corner.append(captions, button, bars, status);
  root.replaceChildren(face, corner);

  const refresh = (): void => {
    const level = face.connection;
    corner.hidden = level === 'none';
    bars.dataset['level'] = level;
    const said = page.connection[level];
    bars.title = said;
    if (status.textContent !== said) status.textContent = said;
    const label = face.paused ? page.play : page.pause;
    if (button.getAttribute('aria-label') !== label) {
      button.setAttribute('aria-label', label);
      button.title = label;
      button.replaceChildren(svg(`<path d="${face.paused ? paths.play : paths.pause}"/>`));
    }
    captions.hidden = button.hidden = face.state === 'error' || face.state === 'ended';
  };
  face.addEventListener('statechange', refresh);
  setInterval(refresh, 1000);
  face.addEventListener('playing', () => keepOffline(), { once: true });
  stayAwake(() => face.state === 'playing');
  refresh();
  Object.assign(window, { semblanteFace: face });
}

const root = document.querySelector('main');
if (root) void main(root);

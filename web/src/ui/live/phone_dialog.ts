import { encode } from 'uqr';
import { isLoopback, phoneLink } from '../../net/phone_link.ts';
import { problemOf, titleOf } from '../../net/problem.ts';
import { getSession } from '../../net/session.ts';
import type { Session, StreamInfo } from '../../net/types.ts';
import { showDialog } from '../shared/dialog.ts';
import { h, replace, setText, svg } from '../shared/dom.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/** How long an invitation is accepted, s. */
const invitationLife = 12 * 3600;
/** The light margin that readers of QR codes need, modules. */
const quietZone = 4;

/** A QR code, dark on light whatever the page's theme, since not every reader takes the inverse. */
function qrPicture(text: string): SVGElement {
  const { data, size } = encode(text, { ecc: 'M', border: quietZone });
  const dark = data.flatMap((row, y) => row.map((on, x) => (on ? `M${x} ${y}h1v1h-1z` : ''))).join('');
  return svg(
    'svg',
    { viewBox: `0 0 ${size} ${size}`, class: 'qr', role: 'img', 'aria-label': t('QR code of the address'), 'shape-rendering': 'crispEdges' },
    svg('rect', { width: size, height: size, fill: '#fff' }),
    svg('path', { d: dark, fill: '#000' }),
  );
}

/** What a phone without a token needs to show the stream; empty when it needs nothing. */
function privacyWords(session: Session, stream: StreamInfo): string {
  if (!session.asks_for_tokens || stream.is_public) return '';
  return session.scope === 'admin'
    ? t('The stream is private. An invitation opens this stream, and nothing else, for 12 hours.')
    : t('The stream is private: the phone needs a token. Somebody with the scope admin can make an invitation here.');
}

/** Shows how a phone opens a stream: a QR code, the address, and an invitation where the server asks for tokens. */
export class PhoneDialog {
  private readonly place = h('div', { class: 'phone-code' });
  private readonly address = h('input', { type: 'text', readonly: true, id: 'phone-address' });
  private readonly note = h('p', { class: 'small', role: 'status' });
  private readonly privacy = h('p', { class: 'small', role: 'status' });
  private readonly invite = h(
    'button',
    { type: 'button', hidden: true, on: { click: () => void this.makeInvitation() } },
    t('Make an invitation'),
  );
  private readonly machine = h('select', { id: 'phone-machine', hidden: true, on: { change: () => this.draw() } });
  private readonly machineLabel = h('label', { for: 'phone-machine', hidden: true }, t('This machine in the network'));
  private readonly base: string;
  /** Of an invitation that was made here. */
  private secret: string | undefined;

  constructor(
    private readonly studio: Studio,
    private readonly stream: StreamInfo,
  ) {
    this.base = new URL(studio.api.base || '.', location.href).href.replace(/\/(index\.html)?$/, '');
  }

  async open(): Promise<void> {
    this.draw();
    showDialog(
      t('{id} on a phone', { id: this.stream.title || this.stream.id }),
      [this.place, this.note, this.privacy, this.machineLabel, this.machine, h('label', { for: 'phone-address' }, t('Address')), this.address],
      [
        this.invite,
        h('button', { type: 'button', on: { click: () => void this.copy() } }, t('Copy')),
        h('button', { type: 'submit', class: 'primary' }, t('Close')),
      ],
    );
    try {
      const session = await getSession(this.studio.api.base);
      this.offerNetwork(session.network_urls);
      const words = privacyWords(session, this.stream);
      setText(this.privacy, words);
      this.invite.hidden = words === '' || session.scope !== 'admin';
    } catch (error) {
      setText(this.privacy, titleOf(problemOf(error)));
    }
  }

  /** Where the page itself was opened by an address that only this machine has, the server's in its networks take its place. */
  private offerNetwork(urls: readonly string[]): void {
    if (!isLoopback(new URL(this.base).hostname) || urls.length === 0) return;
    replace(this.machine, ...urls.map((url) => h('option', { value: url }, new URL(url).host)));
    this.machine.hidden = this.machineLabel.hidden = urls.length === 1;
    this.draw();
  }

  private draw(): void {
    // The path is the page's also in a folder of the server.
    const base = this.machine.value === '' ? this.base : this.machine.value + new URL(this.base).pathname.replace(/\/$/, '');
    const link = phoneLink(base, this.stream.id, this.secret);
    this.address.value = link;
    const reachable = !isLoopback(new URL(link).hostname);
    replace(this.place, reachable ? qrPicture(link) : null);
    setText(
      this.note,
      reachable
        ? t('Point the phone’s camera at the code.')
        : t('This address exists on this machine only. Start the server with “semblante serve --lan” and open the studio by the address that it prints.'),
    );
  }

  private async makeInvitation(): Promise<void> {
    this.invite.disabled = true;
    try {
      this.secret = await this.studio.api.inviteTo(this.stream.id, invitationLife);
      this.draw();
      this.invite.hidden = true;
      setText(this.privacy, t('Whoever has this address sees the stream, for 12 hours.'));
    } catch (error) {
      setText(this.privacy, titleOf(problemOf(error)));
    }
    this.invite.disabled = false;
  }

  private async copy(): Promise<void> {
    this.address.select();
    try {
      await navigator.clipboard.writeText(this.address.value);
      setText(this.note, t('Copied.'));
    } catch {
      setText(this.note, t('The browser does not let this page copy; the address is selected.'));
    }
  }
}

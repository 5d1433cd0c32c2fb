import { neutralFrame } from '@client/index.ts';
import { frameToJson, type JsonFrame } from '@protocol/json_codec.ts';
import { codeFor, codeLanguages, sendsIntoStream, type CodeLanguage } from '../../net/code_examples.ts';
import { problemOf } from '../../net/problem.ts';
import { getSession } from '../../net/session.ts';
import type { LiveModel } from '../live/live_model.ts';
import { showDialog } from '../shared/dialog.ts';
import { h, redraw, replace, setText } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import type { Studio } from '../shared/studio.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import { t } from '../../words/words.ts';

/** A button that shows programs which make the face on the stage. */
export function codeButton(studio: Studio, live: LiveModel, driver: FaceDriver): HTMLButtonElement {
  const button = h(
    'button',
    {
      type: 'button',
      class: 'quiet',
      title: t('Programs that make this face'),
      on: { click: () => void new CodeDialog(studio, live, shownFrame(live, driver)).open() },
    },
    icon('code', 16),
    t('Code'),
  );
  studio.selected.watch((model) => (button.disabled = model?.state !== 'parametrized'));
  return button;
}

/** The frame on the face now; of a stream, the newest one received. */
function shownFrame(live: LiveModel, driver: FaceDriver): JsonFrame {
  const shown = driver.shownFrame();
  if (shown) return frameToJson(shown.state, shown.steps);
  return frameToJson(live.subscriber.value?.newest ?? neutralFrame());
}

/** Programs in several languages for one frame, each to be copied whole. */
class CodeDialog {
  private readonly body = h('div', { class: 'code-body' });
  private readonly note = h('p', { class: 'small', role: 'status' });
  private readonly copyButton = h('button', { type: 'button', on: { click: () => void this.copy() } }, t('Copy'));
  private readonly server: string;
  private language: CodeLanguage = 'curl';
  private stream: string;
  private asksForTokens = false;
  private text = '';

  constructor(
    private readonly studio: Studio,
    private readonly live: LiveModel,
    private readonly frame: JsonFrame,
  ) {
    this.server = new URL(studio.api.base || '.', location.href).href.replace(/[?#].*$/, '').replace(/\/(index\.html)?$/, '');
    const wanted = live.sending.value ?? live.following.value;
    const own = live.ownStreams;
    this.stream = (own.find(({ id }) => id === wanted) ?? own[0])?.id ?? '';
  }

  async open(): Promise<void> {
    this.draw();
    showDialog(
      t('This face in code'),
      [this.body, this.note],
      [this.copyButton, h('button', { type: 'submit', class: 'primary' }, t('Close'))],
    ).classList.add('wide');
    try {
      this.asksForTokens = (await getSession(this.studio.api.base)).asks_for_tokens;
      this.draw();
    } catch (error) {
      setText(this.note, problemOf(error).title);
    }
  }

  private draw(): void {
    redraw(this.body, () => this.drawBody());
  }

  private drawBody(): void {
    const sends = sendsIntoStream(this.language);
    const ready = !sends || this.stream !== '';
    this.copyButton.disabled = !ready;
    this.text = codeFor(this.language, this.frame, {
      server: this.server,
      stream: this.stream,
      model: this.studio.selected.value?.id ?? '',
      asksForTokens: this.asksForTokens,
    });
    replace(
      this.body,
      h('div', { class: 'segments', role: 'group', 'aria-label': t('Programming language') }, codeLanguages.map((name) => this.languageButton(name))),
      h(
        'p',
        { class: 'small' },
        sends ? t('Sends this face into a stream: all who watch it see it.') : t('Computes the vertices of this head with this face.'),
        this.asksForTokens ? ` ${t('The token is read from SEMBLANTE_TOKEN.')}` : null,
      ),
      sends ? (ready ? this.streamSelect() : this.streamMaker()) : null,
      ready ? h('pre', { class: 'code', tabindex: 0, 'data-focus': 'code', 'aria-label': t('Program') }, this.text) : null,
    );
  }

  private languageButton(name: CodeLanguage): HTMLElement {
    const choose = (): void => {
      this.language = name;
      setText(this.note, '');
      this.draw();
    };
    return h(
      'button',
      { type: 'button', 'data-focus': name, 'aria-pressed': String(name === this.language), on: { click: choose } },
      name,
    );
  }

  private streamSelect(): HTMLElement {
    const select = h(
      'select',
      { id: 'code-stream', 'data-focus': 'stream' },
      this.live.ownStreams.map(({ id, title }) => h('option', { value: id, selected: id === this.stream }, title || id)),
    );
    select.addEventListener('change', () => {
      this.stream = select.value;
      this.draw();
    });
    return h('label', { class: 'field-row', for: 'code-stream' }, h('span', {}, t('Stream')), select);
  }

  private streamMaker(): HTMLElement {
    const make = async (): Promise<void> => {
      const title = t('{name}, from a program', { name: this.studio.selected.value?.name ?? t('Head') });
      this.stream = (await this.live.create(title)) ?? '';
      this.draw();
    };
    return h(
      'div',
      { class: 'notice' },
      h('span', { class: 'grow' }, t('There is no stream to send into yet.')),
      h('button', { type: 'button', 'data-focus': 'stream', on: { click: () => void make() } }, t('Create a new stream')),
    );
  }

  private async copy(): Promise<void> {
    try {
      await navigator.clipboard.writeText(this.text);
      setText(this.note, t('Copied.'));
    } catch {
      const program = this.body.querySelector('pre');
      if (program) getSelection()?.selectAllChildren(program);
      setText(this.note, t('The browser does not let this page copy; the program is selected.'));
    }
  }
}

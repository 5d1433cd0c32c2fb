import { neutralFrame } from '@client/index.ts';
import { frameToJson, type JsonFrame } from '@protocol/json_codec.ts';
import { codeFor, codeLanguages, sendsIntoStream, type CodeLanguage } from '../../net/code_examples.ts';
import { clipCode, recordingCode } from '../../net/code_motion.ts';
import { problemOf, titleOf } from '../../net/problem.ts';
import { getSession } from '../../net/session.ts';
import type { Recording, RecordingFormat } from '../../net/types.ts';
import type { LiveModel } from '../live/live_model.ts';
import { showDialog } from '../shared/dialog.ts';
import { h, redraw, replace, setText } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import { formatsOf } from '../shared/recording_formats.ts';
import { needsFace } from '../shared/needs_face.ts';
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
  const setFace = needsFace(button, button.title, studio);
  studio.selected.watch((model) => setFace(model?.state === 'parametrized'));
  return button;
}

/** The frame on the face now; of a stream, the newest one received. */
function shownFrame(live: LiveModel, driver: FaceDriver): JsonFrame {
  const shown = driver.shownFrame();
  if (shown) return frameToJson(shown.state, shown.steps);
  return frameToJson(live.subscriber.value?.newest ?? neutralFrame());
}

/** What a program is about: the face on the stage, a clip in which it comes and goes, or a recording. */
type Topic = 'face' | 'clip' | 'recording';

/** Programs in several languages, each to be copied whole. */
class CodeDialog {
  private readonly body = h('div', { class: 'code-body' });
  private readonly note = h('p', { class: 'small', role: 'status' });
  private readonly copyButton = h('button', { type: 'button', on: { click: () => void this.copy() } }, t('Copy'));
  private readonly server: string;
  private topic: Topic = 'face';
  private language: CodeLanguage = 'curl';
  /** Newest first; null until the first answer. */
  private recordings: readonly Recording[] | null = null;
  private recording = '';
  private format: RecordingFormat = 'glb';
  private dialog: HTMLDialogElement | null = null;
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
    this.dialog = showDialog(
      t('Programs to copy'),
      [this.body, this.note],
      [this.copyButton, h('button', { type: 'submit', class: 'primary' }, t('Close'))],
    );
    this.dialog.classList.add('wide');
    try {
      this.asksForTokens = (await getSession(this.studio.api.base)).asks_for_tokens;
      this.draw();
    } catch (error) {
      setText(this.note, titleOf(problemOf(error)));
    }
  }

  private draw(): void {
    redraw(this.body, () => this.drawBody());
  }

  private drawBody(): void {
    const sends = this.topic === 'face' && sendsIntoStream(this.language);
    const ready = this.topic === 'recording' ? this.recording !== '' : !sends || this.stream !== '';
    this.copyButton.disabled = !ready;
    this.text = ready ? this.program() : '';
    replace(
      this.body,
      this.topicSelect(),
      h('div', { class: 'segments', role: 'group', 'aria-label': t('Programming language') }, codeLanguages.map((name) => this.languageButton(name))),
      h('p', { class: 'small' }, this.meaning(), this.asksForTokens ? ` ${t('The token is read from SEMBLANTE_TOKEN.')}` : null),
      sends ? (ready ? this.streamSelect() : this.streamMaker()) : null,
      this.topic === 'recording' ? this.recordingChoice() : null,
      ready ? h('pre', { class: 'code', tabindex: 0, 'data-focus': 'code', 'aria-label': t('Program') }, this.text) : null,
    );
  }

  private program(): string {
    const target = {
      server: this.server,
      stream: this.stream,
      model: this.studio.selected.value?.id ?? '',
      asksForTokens: this.asksForTokens,
    };
    switch (this.topic) {
      case 'face':
        return codeFor(this.language, this.frame, target);
      case 'clip':
        return clipCode(this.language, this.frame, target);
      case 'recording':
        return recordingCode(this.language, this.recording, this.format, target);
    }
  }

  private meaning(): string {
    switch (this.topic) {
      case 'face':
        return sendsIntoStream(this.language) ? t('Sends this face into a stream: all who watch it see it.') : t('Computes the vertices of this head with this face.');
      case 'clip':
        return this.language === 'C'
          ? t('Computes the vertices of two seconds in which this face comes and goes.')
          : t('Saves two seconds in which this face comes and goes as an animated GLB. The cues can be any performance.');
      case 'recording':
        return this.language === 'C' ? t('Computes the vertices of this head with each moment of a recording.') : t('Saves a recording in a format of your choice.');
    }
  }

  private topicSelect(): HTMLElement {
    const names: Record<Topic, string> = { face: t('This face'), clip: t('A clip'), recording: t('A recording') };
    const options = (Object.keys(names) as Topic[]).map((name) => h('option', { value: name, selected: name === this.topic }, names[name]));
    return this.select('topic', t('Program for'), options, (value) => {
      this.topic = value as Topic;
      if (this.topic === 'recording' && this.recordings === null) void this.loadRecordings();
    });
  }

  private async loadRecordings(): Promise<void> {
    try {
      const all = await this.studio.api.listRecordings(null);
      this.recordings = all.filter(({ state, frames }) => state === 'finished' && frames > 0).reverse();
      this.recording = this.recordings[0]?.id ?? '';
      this.draw();
    } catch (error) {
      setText(this.note, titleOf(problemOf(error)));
    }
  }

  private recordingChoice(): HTMLElement | HTMLElement[] | null {
    if (this.recordings === null) return null;
    if (this.recordings.length === 0) {
      const record = (): void => {
        this.dialog?.close();
        this.studio.tab.set('live');
      };
      return h(
        'div',
        { class: 'notice' },
        h('span', { class: 'grow' }, t('Nothing has been recorded yet.')),
        h('button', { type: 'button', 'data-focus': 'record', on: { click: record } }, t('Record in the Live tab')),
      );
    }
    const names = this.recordings.map(({ id, name }) => h('option', { value: id, selected: id === this.recording }, name));
    const possible = formatsOf(this.recordings.find(({ id }) => id === this.recording)?.sound ?? null);
    if (!possible.some(([format]) => format === this.format)) this.format = possible[0]![0];
    const formats = possible.map(([format, name]) => h('option', { value: format, selected: format === this.format }, name));
    return [
      this.select('recording', t('Recording'), names, (value) => (this.recording = value)),
      ...(this.language === 'C' ? [] : [this.select('format', t('Format'), formats, (value) => (this.format = value as RecordingFormat))]),
    ];
  }

  private select(name: string, label: string, options: HTMLElement[], choose: (value: string) => void): HTMLElement {
    const select = h('select', { id: `code-${name}`, 'data-focus': name }, options);
    select.addEventListener('change', () => {
      choose(select.value);
      setText(this.note, '');
      this.draw();
    });
    return h('label', { class: 'field-row', for: `code-${name}` }, h('span', {}, label), select);
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
    const options = this.live.ownStreams.map(({ id, title }) => h('option', { value: id, selected: id === this.stream }, title || id));
    return this.select('stream', t('Stream'), options, (value) => (this.stream = value));
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

import { streamUrl, type FaceFrame } from '@client/index.ts';
import { decodeJson } from '@protocol/json_codec.ts';
import { requestBlob, requestBytes, requestBytesUpTo, requestJson, type Answer } from './http.ts';
import { mediaTypeOf } from './model_formats.ts';
import { ApiError } from './problem.ts';
import type {
  AbsentFap,
  ExtractionOptions,
  FapPlaying,
  FeaturePointsBody,
  FeaturePointsEdit,
  FeaturePointSet,
  FitReport,
  FrameWish,
  Job,
  Model,
  ModelAndJob,
  ModelEdit,
  ModelPage,
  ParametrizationOptions,
  PartRole,
  Playing,
  PlayOptions,
  RecordedFrames,
  Recording,
  RecordingFormat,
  RecordingPage,
  RecordingPlay,
  Speech,
  StreamSpeech,
  RecordingRequest,
  SpeechRequest,
  StreamInfo,
  NewStream,
  NewToken,
  NewTokenWish,
  StreamPage,
  Timeline,
  VoiceName,
  Voices,
  VersionInfo,
  WornEdit,
} from './types.ts';
import { Turns } from './turns.ts';
import { upload } from './upload.ts';

const segment = encodeURIComponent;

/** One method per REST operation. Each throws ApiError with the server's problem document. */
export class Api {
  constructor(readonly base = '') {}

  /** Of requests that have a voice speak on the server. */
  private readonly voiceTurns = new Turns();

  /** All models of all pages, in the server's order: newest first. */
  async listModels(): Promise<Model[]> {
    return this.listAll<ModelPage, Model>('/v1/models?limit=100', (page) => page.models);
  }

  async getModel(id: string): Promise<Model> {
    return (await requestJson<Model>(`${this.base}/v1/models/${segment(id)}`)).value;
  }

  uploadModel(file: File, onProgress: (fraction: number) => void, signal?: AbortSignal): Promise<ModelAndJob> {
    // The server makes the head's name of the file's, which may be longer than a head's and have characters that no name has.
    const url = `${this.base}/v1/models?filename=${segment(file.name)}`;
    return upload<ModelAndJob>(url, file, mediaTypeOf(file.name), onProgress, signal);
  }

  async renameModel(id: string, name: string): Promise<Model> {
    return (await this.patchModel(id, { name })).value;
  }

  /** A role of `null` is replaced by the server's guess. */
  async setRoles(id: string, roles: Record<number, PartRole | null>): Promise<Model> {
    return (await this.patchModel(id, { roles })).value;
  }

  /** Returns the changed model and, if the axes changed, the job that imports its file again. */
  setFrame(id: string, frame: FrameWish): Promise<{ model: Model; job: Job | null }> {
    return this.patchAndJob(id, { frame });
  }

  /** Returns the changed model and, if it is parametrized, the job that makes its package again. */
  wear(id: string, expressions: WornEdit): Promise<{ model: Model; job: Job | null }> {
    return this.patchAndJob(id, { expressions });
  }

  /** Starts a job that takes a displacement set from a file with the mesh of a stored model in an expression. */
  async createExpression(options: ExtractionOptions, expression: File): Promise<Job> {
    const form = new FormData();
    form.set('options', JSON.stringify(options));
    form.set('expression', expression);
    return (await requestJson<Job>(`${this.base}/v1/expressions`, { method: 'POST', body: form })).value;
  }

  async deleteExpression(id: string): Promise<void> {
    await this.remove(`expressions/${segment(id)}`);
  }

  /** Deletes something; what another page has deleted meanwhile is gone as it should be. */
  private async remove(path: string, keepalive = false): Promise<void> {
    await requestJson(`${this.base}/v1/${path}`, { method: 'DELETE', keepalive }).catch((error: unknown) => {
      if (!(error instanceof ApiError && error.problem.status === 404)) throw error;
    });
  }

  private async patchAndJob(id: string, edit: ModelEdit): Promise<{ model: Model; job: Job | null }> {
    const { value: model, location } = await this.patchModel(id, edit);
    const job = location === null ? null : (await requestJson<Job>(`${this.base}${location}`)).value;
    return { model, job };
  }

  private patchModel(id: string, json: ModelEdit): Promise<Answer<Model>> {
    return requestJson<Model>(`${this.base}/v1/models/${segment(id)}`, { method: 'PATCH', json });
  }

  /** A performance document (application/json) or .fap file (text/plain) on a level of detail of a head, as an animated GLB. */
  makeClip(id: string, level: number, motion: Blob): Promise<Blob> {
    const path = `${this.base}/v1/models/${segment(id)}/clip?lod=${level}`;
    return requestBlob(path, { method: 'POST', body: motion, contentType: motion.type });
  }

  /** The face package of a level of detail in one file. */
  getFace(id: string, level: number): Promise<Blob> {
    return requestBlob(`${this.base}/v1/models/${segment(id)}/face.glb?lod=${level}`);
  }

  /** The findings of the fit doctor. */
  async getReport(id: string): Promise<FitReport> {
    return (await requestJson<FitReport>(`${this.base}/v1/models/${segment(id)}/report.json`)).value;
  }

  async deleteModel(id: string): Promise<void> {
    await this.remove(`models/${segment(id)}`);
  }

  /** Has a text spoken; resolves when sound and face are made. */
  async createSpeech(request: SpeechRequest): Promise<Speech> {
    return (await this.voiceTurns.take(() => requestJson<Speech>(`${this.base}/v1/speeches`, { method: 'POST', json: request }))).value;
  }

  /** Has a recording of a text, in a sound file, said by a face; resolves when the face is made. */
  async createSpeechOfRecording(options: RecordingRequest, sound: File): Promise<Speech> {
    const form = new FormData();
    form.set('options', JSON.stringify(options));
    form.set('audio', sound);
    return (await this.voiceTurns.take(() => requestJson<Speech>(`${this.base}/v1/speeches`, { method: 'POST', body: form }))).value;
  }

  async voices(): Promise<VoiceName[]> {
    return (await this.voiceTurns.take(() => requestJson<Voices>(`${this.base}/v1/voices`))).value.voices;
  }

  speechUrl(id: string, file: 'audio' | 'captions' | 'performance' | 'timeline'): string {
    return `${this.base}/v1/speeches/${segment(id)}/${file}`;
  }

  async speechTimeline(id: string): Promise<Timeline> {
    return (await requestJson<Timeline>(this.speechUrl(id, 'timeline'))).value;
  }

  /** The text of the performance document. */
  async speechPerformance(id: string): Promise<string> {
    return (await requestBlob(this.speechUrl(id, 'performance'))).text();
  }

  async deleteSpeech(id: string): Promise<void> {
    // A page that closes sends it too.
    await this.remove(`speeches/${segment(id)}`, true);
  }

  previewUrl(id: string): string {
    return `${this.base}/v1/models/${segment(id)}/preview.glb`;
  }

  preview(id: string, signal?: AbortSignal): Promise<Uint8Array> {
    return requestBytes(this.previewUrl(id), signal);
  }

  /** The same, unless it is large: see `requestBytesUpTo`. */
  smallPreview(id: string, most: number): Promise<{ bytes: Uint8Array | null; read: number }> {
    return requestBytesUpTo(this.previewUrl(id), most);
  }

  /** The artefact with this SHA-256, such as an image of a package. */
  content(sha256: string, signal?: AbortSignal): Promise<Uint8Array> {
    return requestBytes(`${this.base}/v1/artefacts/${segment(sha256)}`, signal);
  }

  getFeaturePoints(id: string): Promise<Answer<FeaturePointSet>> {
    return requestJson<FeaturePointSet>(`${this.base}/v1/models/${segment(id)}/feature-points`);
  }

  /** Replaces the whole set. With the `etag` of the base set the server refuses to overwrite a newer set (412). */
  putFeaturePoints(
    id: string,
    body: FeaturePointsBody,
    options: { etag?: string | null; mirror?: boolean } = {},
  ): Promise<Answer<FeaturePointSet>> {
    const query = options.mirror ? '?fill=mirror' : '';
    const headers: Record<string, string> = options.etag ? { 'If-Match': options.etag } : {};
    return requestJson<FeaturePointSet>(`${this.base}/v1/models/${segment(id)}/feature-points${query}`, {
      method: 'PUT',
      json: body,
      headers,
    });
  }

  /** Changes what the body names; the rest stays. With the `etag` of the base set as in `putFeaturePoints`. */
  patchFeaturePoints(id: string, body: FeaturePointsEdit, etag: string | null): Promise<Answer<FeaturePointSet>> {
    const headers: Record<string, string> = etag ? { 'If-Match': etag } : {};
    return requestJson<FeaturePointSet>(`${this.base}/v1/models/${segment(id)}/feature-points`, {
      method: 'PATCH',
      json: body,
      headers,
    });
  }

  /** Starts a job that proposes the missing points from the set with this `etag`. */
  async proposePoints(id: string, etag: string | null): Promise<Job> {
    const url = `${this.base}/v1/models/${segment(id)}/feature-points/proposals`;
    const headers: Record<string, string> = etag ? { 'If-Match': etag } : {};
    return (await requestJson<Job>(url, { method: 'POST', json: {}, headers })).value;
  }

  async parametrize(id: string, options: ParametrizationOptions): Promise<Job> {
    const url = `${this.base}/v1/models/${segment(id)}/parametrizations`;
    return (await requestJson<Job>(url, { method: 'POST', json: options })).value;
  }

  async getJob(id: string): Promise<Job> {
    return (await requestJson<Job>(`${this.base}/v1/jobs/${segment(id)}`)).value;
  }

  async cancelJob(id: string): Promise<void> {
    await requestJson(`${this.base}/v1/jobs/${segment(id)}`, { method: 'DELETE' });
  }

  jobEventsUrl(id: string): string {
    return `${this.base}/v1/jobs/${segment(id)}/events`;
  }

  /** All streams of all pages; oldest first. */
  async listStreams(): Promise<StreamInfo[]> {
    return this.listAll<StreamPage, StreamInfo>('/v1/streams?limit=200', (page) => page.streams);
  }

  async createStream(title: string, model: string | null, options: NewStream = {}): Promise<StreamInfo> {
    const json: NewStream = model === null ? { title, ...options } : { title, model, ...options };
    return (await requestJson<StreamInfo>(`${this.base}/v1/streams`, { method: 'POST', json })).value;
  }

  /** A token that reads one stream and its model; its text. Needs the scope admin. `life`: seconds. */
  async inviteTo(stream: string, life: number): Promise<string> {
    const json: NewTokenWish = { name: `phone: ${stream}`, scope: 'read', stream, expires_in: life };
    return (await requestJson<NewToken>(`${this.base}/v1/tokens`, { method: 'POST', json })).value.secret;
  }

  async deleteStream(id: string, keepalive = false): Promise<void> {
    await this.remove(`streams/${segment(id)}`, keepalive);
  }

  /** Starts playing a performance document into a stream. */
  async playPerformance(stream: string, document: Blob, options: PlayOptions): Promise<Playing> {
    const url = `${this.base}/v1/streams/${segment(stream)}/performances?${playQuery(options)}`;
    return (await requestJson<Playing>(url, { method: 'POST', body: document, contentType: 'application/json' })).value;
  }

  /** Starts playing a .fap file into a stream. */
  async playFap(stream: string, file: Blob, options: PlayOptions, absent: AbsentFap): Promise<FapPlaying> {
    const url = `${this.base}/v1/streams/${segment(stream)}/fap?${playQuery(options)}&absent=${absent}`;
    return (await requestJson<FapPlaying>(url, { method: 'POST', body: file, contentType: 'text/plain' })).value;
  }

  /** The face of the stream says a text from now on. */
  async speakIntoStream(stream: string, speech: StreamSpeech): Promise<Playing> {
    const path = `${this.base}/v1/streams/${segment(stream)}/speech`;
    return (await this.voiceTurns.take(() => requestJson<Playing>(path, { method: 'POST', json: speech }))).value;
  }

  /** Stops a performance, .fap file or recording; the face returns to neutral. */
  async stopPlaying(stream: string, id: string): Promise<void> {
    await requestJson(`${this.base}/v1/streams/${segment(stream)}/performances/${segment(id)}`, { method: 'DELETE' });
  }

  /** The recordings of a stream, or of all streams (`null`); oldest first. */
  async listRecordings(stream: string | null): Promise<Recording[]> {
    const url = stream === null ? '/v1/recordings' : `/v1/streams/${segment(stream)}/recordings`;
    return this.listAll<RecordingPage, Recording>(`${url}?limit=200`, (page) => page.recordings);
  }

  async startRecording(stream: string): Promise<Recording> {
    const url = `${this.base}/v1/streams/${segment(stream)}/recordings`;
    return (await requestJson<Recording>(url, { method: 'POST', json: {} })).value;
  }

  /** Resolves when the whole recording is on the server's disk. `keepalive`: the page closes meanwhile. */
  async stopRecording(id: string, keepalive = false): Promise<Recording> {
    const url = `${this.base}/v1/recordings/${segment(id)}/stop`;
    return (await requestJson<Recording>(url, { method: 'POST', json: {}, keepalive })).value;
  }

  async deleteRecording(id: string): Promise<void> {
    await this.remove(`recordings/${segment(id)}`);
  }

  /** `model`: the head that a GLB clip animates; other formats ignore it. */
  recordingContent(id: string, format: RecordingFormat, model: string | null): Promise<Blob> {
    const query = new URLSearchParams({ format, ...(format === 'glb' && model !== null ? { model } : {}) });
    return requestBlob(`${this.base}/v1/recordings/${segment(id)}/content?${query.toString()}`);
  }

  /** The frame shown at a time, ms after the first frame. */
  async recordedFrame(id: string, at: number): Promise<FaceFrame> {
    const url = `${this.base}/v1/recordings/${segment(id)}/frames?at=${Math.round(at)}`;
    const { frames } = (await requestJson<RecordedFrames>(url)).value;
    const message = decodeJson(JSON.stringify({ type: 'frames', sequence: 0, media_time: 0, frames }));
    if (message.type !== 'frames') throw new TypeError('expected a message of type frames');
    return message.frames[0]!.state;
  }

  /** Starts playing a recording into a stream. */
  async playRecording(stream: string, recording: string, options: PlayOptions): Promise<Playing> {
    const url = `${this.base}/v1/streams/${segment(stream)}/plays`;
    const json: RecordingPlay = { recording, ...options };
    return (await requestJson<Playing>(url, { method: 'POST', json })).value;
  }

  /** What all pages of a list have; `path` has a query. */
  private async listAll<Page extends { next: string | null }, Item>(path: string, itemsOf: (page: Page) => Item[]): Promise<Item[]> {
    const items: Item[] = [];
    let after: string | null = null;
    do {
      const query: string = after === null ? '' : `&after=${segment(after)}`;
      const { value: page }: { value: Page } = await requestJson<Page>(`${this.base}${path}${query}`);
      items.push(...itemsOf(page));
      after = page.next;
    } while (after !== null);
    return items;
  }

  streamUrl(id: string): string {
    return streamUrl(new URL(this.base === '' ? '/' : this.base, location.href).href, id);
  }

  async version(): Promise<VersionInfo> {
    return (await requestJson<VersionInfo>(`${this.base}/version`)).value;
  }
}

const playQuery = ({ loop, from, take_over }: PlayOptions): string =>
  new URLSearchParams({ loop: String(loop), from: String(from), take_over: String(take_over) }).toString();

/** Short names for the types of the REST interface; `npm run types` generates them from server/api/openapi.json. */
import type { PartRole } from '@protocol/rig_document.ts';
import type { components, operations } from './generated/api.ts';

export type { PartRole };

type Schemas = components['schemas'];
/** The type of an operation's JSON request body. */
type JsonBody<Request> = Request extends { requestBody?: { content: { 'application/json': infer Body } } }
  ? Body
  : never;
/** The type of an operation's JSON response with a given status. */
type JsonAnswer<Name extends keyof operations, Status extends number> = operations[Name]['responses'] extends {
  [status in Status]: { content: { 'application/json': infer Answer } };
}
  ? Answer
  : never;

/** RFC 9457. The server always sends `detail`; a problem made by a proxy or by this page may lack it. */
export type Problem = Omit<Schemas['Problem'], 'detail'> & Partial<Pick<Schemas['Problem'], 'detail'>>;
export type Vector = Schemas['Vector'];

export type Model = Schemas['Model'];
export type ModelPage = JsonAnswer<'listModels', 200>;
export type ModelEdit = Schemas['ModelEdit'];
/** Visemes and expressions by name with the set that a face wears in their place; null: the library's. */
export type WornEdit = NonNullable<ModelEdit['expressions']>;
export type ExtractionOptions = Schemas['ExtractionOptions'];
export type ModelAndJob = JsonAnswer<'createModel', 202>;
export type ModelPart = Schemas['Part'];
export type FacePackage = NonNullable<Model['package']>;
export type PackageLevel = Schemas['Level'];

export type ModelFrame = Schemas['ModelFrame'];
export type FrameWish = Schemas['FrameWish'];
export type LengthUnit = Schemas['LengthUnit'];
export type Direction = Schemas['Direction'];

export type FitReport = Schemas['Report'];
export type Finding = Schemas['Finding'];
export type FindingCounts = Schemas['FindingCounts'];
export type Severity = Finding['severity'];
export type LevelError = Schemas['SurfaceError'];

export type FeaturePointSet = Schemas['FeaturePoints'];
export type FeaturePointsBody = Schemas['FeaturePointsBody'];
export type FeaturePointsEdit = Schemas['FeaturePointsEdit'];
export type FeaturePointValue = FeaturePointSet['points'][string];
export type ParametrizationOptions = JsonBody<operations['createParametrization']>;

export type Job = Schemas['Job'];
export type JobState = Job['state'];
/** The result of a finished proposal job: the number of proposed points, and why others were not proposed. */
export type ProposalsResult = Extract<NonNullable<Job['result']>, { proposed: number }>;
/** The result of a finished extraction job: the set that was taken from an example. */
export type ExtractionResult = Extract<NonNullable<Job['result']>, { expression: string }>;

export type Speech = Schemas['Speech'];
export type SpeechRequest = Schemas['SpeechRequest'];
/** A text, or a stored speech, that a stream says. */
export type StreamSpeech = Schemas['StreamSpeech'];
export type RecordingRequest = Schemas['TimelineSpeechRequest'];
export type Timeline = Schemas['Timeline'];
export type Voices = Schemas['Voices'];
export type VoiceName = Voices['voices'][number];

export type Session = Schemas['Session'];
export type NewToken = Schemas['NewToken'];
export type NewTokenWish = JsonBody<operations['createToken']>;
export type StreamInfo = Schemas['Stream'];
export type StreamPage = JsonAnswer<'listStreams', 200>;
/** The options of a new stream; each has a default on the server. */
export type NewStream = JsonBody<operations['createStream']>;
export type Playing = Schemas['Playing'];
export type FapPlaying = JsonAnswer<'playFapFile', 202>;
export type RecordingPlay = JsonBody<operations['playRecording']>;
/** Start position (ms), looping, and whether to take the stream over from its current source. */
export type PlayOptions = Required<Omit<RecordingPlay, 'recording'>>;
export type AbsentFap = NonNullable<NonNullable<operations['playFapFile']['parameters']['query']>['absent']>;

export type Recording = Schemas['Recording'];
export type RecordingPage = Schemas['Recordings'];
/** The download formats that the studio offers: all except the server's own file format. */
export type RecordingFormat = Exclude<components['parameters']['contentFormat'], 'recording'>;
export type RecordedFrames = Schemas['RecordedFrames'];

export type VersionInfo = JsonAnswer<'getVersion', 200>;

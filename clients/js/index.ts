export * from './face.ts';
export * from './face_error.ts';
export type { DracoModule, FaceMesh } from './draco_mesh.ts';
export * from './kernel.ts';
export * from './stream_client.ts';
export * from './stream_types.ts';
export * from './stream_clock.ts';
export * from './stream_memory.ts';
export * from './player.ts';
export { Runtime, type ModuleSource } from './runtime.ts';
export { ProtocolError } from '../../protocol/ts/protocol_error.ts';
export { neutralFrame, type ExpressionBlend, type FaceFrame, type TimedFrame, type VisemeBlend } from '../../protocol/ts/face_frame.ts';
// For those who name what they hear of a stream: all that `StreamEvents` and `StreamOptions` are made of.
export type { End, EndReason, Frames, Header, Keyframe, SoundTrack, StreamError, StreamErrorCode, StreamRole, VoiceState } from '../../protocol/ts/messages.ts';
export type { QuantizerSteps } from '../../protocol/ts/quantizers.ts';
export type { RigDocument } from '../../protocol/ts/rig_document.ts';
export type { InfluenceTable } from '../../protocol/ts/weights_format.ts';

export * from './face.ts';
export * from './face_error.ts';
export type { DracoModule, FaceMesh } from './draco_mesh.ts';
export * from './kernel.ts';
export * from './stream_client.ts';
export * from './player.ts';
export { Runtime, type ModuleSource } from './runtime.ts';
export { ProtocolError } from '../../protocol/ts/protocol_error.ts';
export * from './performance.ts';
export { readPerformance, type PerformanceScript } from '../../protocol/ts/performance_document.ts';
export { neutralFrame, type FaceFrame, type TimedFrame } from '../../protocol/ts/face_frame.ts';
export type { RigDocument } from '../../protocol/ts/rig_document.ts';
export {
  arkitNames,
  fromArkit,
  fromOculus,
  oculusNames,
  toArkit,
  toOculus,
  type ArkitInput,
  type FromArkit,
  type FromOculus,
  type OculusInput,
} from '../../protocol/ts/index.ts';

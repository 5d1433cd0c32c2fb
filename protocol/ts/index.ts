export * from './messages.ts';
export * from './protocol_error.ts';
export * from './json_codec.ts';
export * from './opus_packet.ts';
export * from './quantizers.ts';
export * from './speech_score.ts';
export * from './weights_format.ts';
export * from './rig_document.ts';

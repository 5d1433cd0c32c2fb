/** The stream messages, generated from protocol/schema/messages.json; their meaning is in protocol/SPEC.md. */
export * from './generated/messages.ts';
export * from './face_frame.ts';

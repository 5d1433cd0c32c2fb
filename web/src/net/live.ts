import type { FaceFrame } from '../face/frame.ts';

export interface LinkStatus {
  kind: 'off' | 'connecting' | 'open' | 'waiting' | 'ended';
  title?: string;
  reason?: string;
}

export interface LiveStats {
  framesPerSecond: number;
  bytesPerSecond: number;
  latencyMs: number | null;
  sequence: number;
}

export interface LiveFrameReader {
  read(frame: FaceFrame, now: number): boolean;
}

export class LiveSubscriber implements LiveFrameReader {
  readonly stats: LiveStats = { framesPerSecond: 0, bytesPerSecond: 0, latencyMs: null, sequence: 0 };
  constructor(readonly url: string, readonly title: string, readonly onStatus: (status: LinkStatus) => void) {}
  open(): void {}
  close(): void {}
  read(): boolean {
    return false;
  }
}

export class LivePublisher {
  constructor(readonly url: string, readonly onStatus: (status: LinkStatus) => void) {}
  open(): void {}
  close(): void {}
  push(_frame: FaceFrame): void {}
}

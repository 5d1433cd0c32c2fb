import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Microphone, MicrophoneError, type ListenFiles } from '@client/listen/index.ts';

/** What a browser has and Node does not: a graph of sound whose listener says what the test lets it say. */
class FakeContext {
  state = 'running';
  currentTime = 2;
  readonly audioWorklet = { addModule: () => Promise.resolve() };
  readonly resume = () => Promise.resolve();
  readonly close = () => {
    this.state = 'closed';
    return Promise.resolve();
  };
  readonly createMediaStreamSource = () => ({ context: this, connect: () => undefined, disconnect: () => undefined });
}

class FakeNode {
  readonly port: { onmessage: ((event: { data: object }) => void) | null } = { onmessage: null };
  constructor() {
    nodes.push(this);
  }
}

const track = { stop: vi.fn(), addEventListener: () => undefined };
const emptyModule = new Uint8Array([0x00, 0x61, 0x73, 0x6d, 0x01, 0x00, 0x00, 0x00]);
const files: ListenFiles = { library: () => Promise.resolve(emptyModule), worklet: 'listen_worklet.js' };
const heard = { time: 1000, level: -20, weights: new Float32Array(15), at: 1.9 };
let nodes: FakeNode[];

beforeEach(() => {
  nodes = [];
  vi.stubGlobal('AudioContext', FakeContext);
  vi.stubGlobal('AudioWorkletNode', FakeNode);
  vi.stubGlobal('navigator', {
    mediaDevices: { getUserMedia: () => Promise.resolve({ getTracks: () => [track], getAudioTracks: () => [track] }) },
  });
});
afterEach(() => vi.unstubAllGlobals());

test('Microphone_Open_TellsWhatIsHeard_WithItsDelay', async () => {
  const delays: number[] = [];
  await Microphone.open(files, ({ delay }) => delays.push(delay));
  nodes[0]!.port.onmessage!({ data: heard });
  expect(delays).toEqual([expect.closeTo(100, 6)]);
});

test('Microphone_Closed_TellsNoMore_NotEvenWhatIsOnItsWay', async () => {
  const onHeard = vi.fn();
  const microphone = await Microphone.open(files, onHeard);
  const { port } = nodes[0]!;
  microphone.close();
  port.onmessage?.({ data: heard }); // a port delivers what was posted before, unless nobody receives it
  expect(onHeard).not.toHaveBeenCalled();
  expect(track.stop).toHaveBeenCalled();
});

test('Microphone_LibraryNotLoaded_IsGivenBack', async () => {
  track.stop.mockClear();
  const broken = { ...files, library: () => Promise.reject(new Error('status 404')) };
  await expect(Microphone.open(broken, () => undefined)).rejects.toThrow(MicrophoneError);
  expect(track.stop).toHaveBeenCalled();
});

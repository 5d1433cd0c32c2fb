/** Makes Opus packets of a microphone in a thread of its own, because a page that draws would lose samples. */
import { packetDuration, type WorkerMessage } from './voice_encoder.ts';

const bitrate = 24_000;
/** Packets of silence have at most so many bytes (RFC 6716, section 2.1.9: DTX). */
const silentBytes = 2;

const tell = (message: WorkerMessage): void => postMessage(message);

async function encode(readable: ReadableStream<AudioData>): Promise<void> {
  /** The end of the newest block, by the clock of the sound, and when it came; ms. */
  let end = 0;
  let now = 0;
  const encoder = new AudioEncoder({
    output: (chunk) => {
      if (chunk.byteLength <= silentBytes) return;
      const packet = new Uint8Array(chunk.byteLength);
      chunk.copyTo(packet);
      tell({ packet, begin: chunk.timestamp / 1000, end, now });
    },
    error: ({ message }) => tell({ fault: message }),
  });
  const reader = readable.getReader();
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    const { value: data } = part;
    if (encoder.state === 'unconfigured')
      encoder.configure({
        codec: 'opus',
        sampleRate: data.sampleRate,
        numberOfChannels: data.numberOfChannels,
        bitrate,
        opus: { application: 'voip', frameDuration: packetDuration * 1000, signal: 'voice', usedtx: true },
      } as AudioEncoderConfig);
    end = (data.timestamp + data.duration) / 1000;
    now = performance.timeOrigin + performance.now();
    if (encoder.state === 'configured') encoder.encode(data);
    data.close();
  }
}

addEventListener('message', ({ data }: MessageEvent<ReadableStream<AudioData>>) => {
  encode(data).catch((error: unknown) => tell({ fault: String(error) }));
});

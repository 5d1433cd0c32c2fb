// Walks through streams: frames, playback and recordings.
import assert from 'node:assert/strict';
import { type Client, type Schemas, good, raw, refused } from './client.js';
import type { Glbs } from './face.js';

async function sendFrames(client: Client, stream: string): Promise<void> {
  const params = { path: { stream } };
  const frames: Schemas['FaceFrame'][] = [
    { time: 0, viseme: { select1: 10 }, expression: { select1: 1, intensity1: 63 } },
    { time: 40, faps: { '3': 200, '49': 12_000 } },
    { time: 80, arkit: { jawOpen: 0.5 }, oculus: { aa: 1 } },
    { time: 120, arkit: new Array<number>(61).fill(0.1) },
  ];
  const sent = good(await client.POST('/v1/streams/{stream}/frames', { params, body: { frames } }));
  assert.deepEqual([sent.accepted, sent.clamped], [4, 0]);
  const bad = refused(
    await client.POST('/v1/streams/{stream}/frames', { params, body: { frames: [{ faps: { '99': 1 } }] } }),
    422,
  );
  assert.deepEqual([bad.type, bad.pointer], ['/problems/invalid-frame', '/frames/0/faps/99']);
}

async function readRecording(client: Client, recording: string, glbs: Glbs): Promise<void> {
  const path = { recording };
  const page = good(await client.GET('/v1/recordings/{recording}/frames', { params: { path, query: { limit: 3 } } }));
  assert.equal(page.frames[0]?.viseme?.select1, 10);
  assert.equal(page.frames.length, 3);
  assert.ok(page.next);
  const content = async (format: 'performance' | 'frames-json' | 'fap' | 'arkit-csv' | 'glb' | 'recording') =>
    new Uint8Array(
      good(
        await client.GET('/v1/recordings/{recording}/content', {
          params: { path, query: { format } },
          parseAs: 'arrayBuffer',
        }),
      ),
    );
  for (const format of ['performance', 'frames-json', 'fap', 'arkit-csv', 'recording'] as const)
    assert.ok((await content(format)).byteLength > 0, format);
  glbs['recording.glb'] = await content('glb');
}

async function speak(client: Client, stream: string): Promise<void> {
  const body: Schemas['SpeechRequest'] = { text: 'Mamma mia! :)', language: 'en', seed: 7, style: 'lively' };
  assert.deepEqual(good(await client.GET('/v1/voices')).voices.map(({ voice }) => voice), ['beeps']);
  const speech = good(await client.POST('/v1/speeches', { body }));
  assert.deepEqual([speech.text, speech.request], ['Mamma mia! ', body]);
  const params = { path: { speech: speech.id } };
  assert.deepEqual(good(await client.GET('/v1/speeches/{speech}', { params })), speech);
  assert.equal(good(await client.GET('/v1/speeches')).speeches.length, 1);
  const sound = good(await client.GET('/v1/speeches/{speech}/audio', { params, parseAs: 'arrayBuffer' }));
  assert.equal(new TextDecoder().decode(new Uint8Array(sound as ArrayBuffer).slice(0, 4)), 'RIFF');
  assert.equal(good(await client.GET('/v1/speeches/{speech}/timeline', { params })).words[0]?.text, 'Mamma');
  assert.ok((good(await client.GET('/v1/speeches/{speech}/performance', { params })).cues ?? []).length > 0);
  assert.match(good(await client.GET('/v1/speeches/{speech}/captions', { params, parseAs: 'text' })) as string, /^WEBVTT/);
  const path = { stream };
  const said = good(
    await client.POST('/v1/streams/{stream}/speech', { params: { path }, body: { speech: speech.id, take_over: true } }),
  );
  assert.equal(said.kind, 'performance');
  assert.equal((await client.DELETE('/v1/speeches/{speech}', { params })).response.status, 204);
}

async function playThings(client: Client, stream: string, recording: string): Promise<void> {
  const params = { path: { stream } };
  const query = { loop: true, take_over: true };
  const body: Schemas['Performance'] = {
    format: 'semblante.performance',
    version: 1,
    idle: { seed: 7 },
    cues: [{ time: 0, duration: 2000, expression: 'joy', value: 0.8, easing: 'ease_in' }],
  };
  good(await client.POST('/v1/streams/{stream}/performances', { params: { ...params, query }, body }));
  const numbers = Array.from({ length: 68 }, (_, fap) => (fap === 2 ? 1 : 0)).join(' ');
  const fap = `2.1 short 25 1\n${numbers}\n0 200\n`;
  const played = good(
    await client.POST('/v1/streams/{stream}/fap', { params: { ...params, query }, ...raw('text/plain'), body: fap }),
  );
  assert.deepEqual(played.warnings, []);
  const playing = good(
    await client.POST('/v1/streams/{stream}/plays', { params, body: { recording, loop: true, take_over: true } }),
  );
  assert.deepEqual([playing.kind, playing.loop], ['recording', true]);
  refused(await client.POST('/v1/streams/{stream}/plays', { params, body: { recording, loop: false, take_over: false } }), 409);
  const at = { path: { stream, performance: playing.id } };
  assert.equal(good(await client.GET('/v1/streams/{stream}/performances/{performance}', { params: at })).id, playing.id);
  const now = good(await client.GET('/v1/streams/{stream}', { params }));
  assert.deepEqual([now.active_source, now.playing?.id], ['recording', playing.id]);
  const stopped = await client.DELETE('/v1/streams/{stream}/performances/{performance}', { params: at });
  assert.equal(stopped.response.status, 204);
}

export async function walkLive(client: Client, model: string, glbs: Glbs): Promise<void> {
  const made = good(
    await client.POST('/v1/streams', { body: { name: 'walk', title: 'Walk', model, batch_interval: 0, quantizer_scale: 1 } }),
  );
  const params = { path: { stream: made.id } };
  const started = good(
    await client.POST('/v1/streams/{stream}/recordings', { params, body: { name: 'Take 1', max_duration: 60_000 } }),
  );
  assert.equal(started.state, 'recording');
  const path = { recording: started.id };
  await sendFrames(client, made.id);
  const ended = good(await client.POST('/v1/recordings/{recording}/stop', { params: { path } }));
  assert.deepEqual([ended.state, ended.ended, ended.frames], ['finished', 'stopped', 4]);
  assert.deepEqual(good(await client.GET('/v1/recordings/{recording}', { params: { path } })), ended);
  assert.equal(good(await client.GET('/v1/recordings')).recordings.length, 1);
  assert.equal(good(await client.GET('/v1/streams/{stream}/recordings', { params })).recordings.length, 1);
  good(await client.GET('/v1/streams/{stream}/recording', { params }));
  await readRecording(client, started.id, glbs);
  await speak(client, made.id);
  await playThings(client, made.id, started.id);
  assert.equal(good(await client.GET('/v1/streams')).streams[0]?.title, 'Walk');

  const gone = await client.DELETE('/v1/recordings/{recording}', { params: { path } });
  assert.equal(gone.response.status, 204);
  refused(await client.GET('/v1/recordings/{recording}', { params: { path } }), 404);
  assert.equal((await client.DELETE('/v1/streams/{stream}', { params })).response.status, 204);
  refused(await client.GET('/v1/streams/{stream}', { params }), 404);
}

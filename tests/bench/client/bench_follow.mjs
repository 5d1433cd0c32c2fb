// What it costs to follow a stream of 60 frames a second and deform a face of 10,000 vertices: decoding, playing, evaluating
// and deforming, by the npm package. With several packages, alternating, so that a busy machine slows all of them.
//
//   node --expose-gc bench_follow.mjs build/npm/semblante [OTHER PACKAGE ...]
import { readFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const vectors = resolve(dirname(fileURLToPath(import.meta.url)), '../../../protocol/vectors');
const vertices = 10_000;
const interval = 1000 / 60;
const framesPerRound = 1800;
const rounds = 8;

let seed = 7;
const random = () => (seed = (seed * 48271) % 0x7fffffff) / 0x7fffffff;

/** As the client reads them: rig.json has an object by point. */
const followers = (by) => Object.entries(by).flatMap(([point, leaders]) => Object.entries(leaders).map(([leader, share]) => ({ point, leader, share })));

/** A head whose vertices follow 1 to 6 feature points each, as on a face. */
function makeFace() {
  const rig = JSON.parse(readFileSync(join(vectors, 'v3/rig.json'), 'utf8'));
  const positions = Float32Array.from({ length: vertices * 3 }, () => random() * 20 - 10);
  const rowOffsets = new Uint32Array(vertices + 1);
  const points = [];
  const weights = [];
  for (let v = 0; v < vertices; ++v) {
    const first = Math.floor(random() * 70);
    const count = v % 3 === 0 ? 0 : 1 + Math.floor(random() * 6);
    for (let i = 0; i < count; ++i) {
      points.push(first + 2 * i);
      weights.push(random());
    }
    rowOffsets[v + 1] = points.length;
  }
  return {
    rig: { ...rig, companions: followers(rig.companions), lower_lip: followers(rig.lower_lip) },
    mesh: { positions, normals: null, uvs: null, materials: null, fileVertices: null, triangles: new Uint32Array() },
    influence: {
      vertexCount: vertices,
      rowOffsets,
      rowPoints: Uint8Array.from(points),
      rowWeights: Float32Array.from(weights),
      rigid: new Uint8Array(vertices),
      turn: Uint8Array.from({ length: vertices }, (_, v) => (v % 2 === 0 ? 255 : 0)),
    },
  };
}

/** A socket whose other end is this program. */
class Socket {
  static last;
  bufferedAmount = 0;
  sent = [];
  constructor() {
    Socket.last = this;
  }
  send(bytes) {
    this.sent.push(new Uint8Array(bytes).slice().buffer);
  }
  close() {}
}

const header = Uint8Array.from(
  Buffer.from(
    JSON.parse(readFileSync(join(vectors, 'v1/messages.json'), 'utf8')).messages.find(({ name }) => name === 'header with the standard steps').binary,
    'hex',
  ),
).buffer;

function connect(of, options) {
  const client = new of.StreamClient('ws://x', { WebSocket: Socket, pingInterval: 0, ...options });
  client.connect();
  const socket = Socket.last;
  socket.onopen();
  socket.onmessage({ data: header });
  socket.sent.length = 0;
  return { client, socket };
}

/** Messages of a face that talks and moves its head: what a publisher sends, one frame each. */
function makeMessages(of) {
  const { client, socket } = connect(of, { role: 'publish', now: () => 0 });
  for (let i = 0; i < framesPerRound * rounds; ++i) {
    const state = of.neutralFrame();
    state.viseme = { select1: 1 + (Math.floor(i / 7) % 14), select2: 1 + (Math.floor(i / 9) % 14), blend: i % 64 };
    for (let fap = 3; fap <= 68; ++fap) state.levels[fap] = Math.round(80 * Math.sin(i / (11 + (fap % 13)) + fap) * (fap % 4 === 0 ? 0 : 1));
    client.publish([{ time: 0, state }], Math.round(1000 + i * interval));
  }
  client.close();
  return socket.sent;
}

async function load(folder) {
  const of = await import(pathToFileURL(resolve(folder, 'dist/index.js')).href);
  if (of.loadRuntime) {
    const runtime = await of.loadRuntime();
    return { folder, of, kernelOf: (face) => new of.Kernel(runtime, face) };
  }
  // Before libsemblante: one instance of the kernel for each face.
  const module = await of.loadKernelModule();
  return { folder, of, kernelOf: (face) => of.Kernel.create(module, face) };
}

const packages = await Promise.all(process.argv.slice(2).map(load));
const face = makeFace();
const messages = makeMessages(packages[0].of);

for (const each of packages) {
  each.now = 0;
  const { client, socket } = connect(each.of, { now: () => each.now });
  each.socket = socket;
  each.kernel = await each.kernelOf(face);
  each.player = new each.of.Player(each.kernel, { now: () => each.now });
  each.player.follow(client);
  each.best = Infinity;
  each.next = 0;
  each.moved = 0;
  each.socket.onmessage({ data: messages[each.next++] });
}

function play(each, count) {
  const begun = process.hrtime.bigint();
  for (let i = 0; i < count && each.next < messages.length; ++i) {
    each.now += interval;
    each.socket.onmessage({ data: messages[each.next++] });
    if (each.player.update(interval / 1000)) {
      each.kernel.deform(each.of.shownPose);
      each.moved += 1;
    }
  }
  return Number(process.hrtime.bigint() - begun) / 1000 / count;
}

for (let round = 0; round + 1 < rounds; ++round) for (const each of packages) each.best = Math.min(each.best, play(each, framesPerRound));
for (const each of packages) {
  globalThis.gc?.();
  const before = process.memoryUsage().heapUsed;
  play(each, 600);
  const bytes = (process.memoryUsage().heapUsed - before) / 600;
  const share = ((each.best * 60) / 1e4).toFixed(2);
  console.log(`${each.folder}: ${each.best.toFixed(1)} us a frame, ${share} % of a core at 60/s; ${bytes.toFixed(0)} bytes of garbage a frame; ${each.moved} frames shown`);
}

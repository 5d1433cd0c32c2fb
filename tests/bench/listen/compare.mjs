// Visemes right per frame of 10 ms, of lip sync by sound: ours, those of npm, and pocketsphinx, on the same recordings.
//   node compare.mjs BUILD SET... [--packages FOLDER]
// SET: a folder of files and label tracks, of core/listen/train/human.py or corpus.py. FOLDER has node_modules with
// @met4citizen/headaudio and wawa-lipsync; those that are missing are left out, as is pocketsphinx.
import { execFileSync, spawnSync } from 'node:child_process';
import { copyFileSync, existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const root = fileURLToPath(new URL('../../..', import.meta.url));
const step = 10; // ms
const names = ['sil', 'PP', 'FF', 'TH', 'DD', 'kk', 'CH', 'SS', 'nn', 'RR', 'aa', 'E', 'I', 'O', 'U'];

const given = process.argv.slice(2);
const at = given.indexOf('--packages');
const packages = at < 0 ? null : resolve(given.splice(at, 2)[1], 'node_modules');
const [build, ...sets] = given;
if (!build || sets.length === 0) {
  console.error('usage: node compare.mjs BUILD SET... [--packages FOLDER]');
  process.exit(2);
}

/** The visemes of each file's label track, as training has them: -1 where the mouth is that of its neighbours. */
function labelsOf(folder) {
  const files = readdirSync(folder).filter((name) => name.endsWith('.wav')).sort();
  const out = join(mkdtempSync(join(tmpdir(), 'listen-')), 'labels');
  execFileSync(join(build, 'bin/semblante-listen-features'), [out, ...files.map((name) => join(folder, name))]);
  const bytes = readFileSync(out);
  const labels = new Map();
  let first = 0;
  for (const name of files) {
    const count = bytes.readInt32LE(first);
    first += 4 + 4 * 25 * count;
    labels.set(name, new Int8Array(bytes.subarray(first, first + count)));
    first += count;
  }
  return labels;
}

function readWav(path) {
  const bytes = readFileSync(path);
  let chunk = 12;
  while (bytes.toString('latin1', chunk, chunk + 4) !== 'data') chunk += 8 + bytes.readUInt32LE(chunk + 4);
  const count = Math.min(bytes.readUInt32LE(chunk + 4), bytes.length - chunk - 8) >> 1;
  return { rate: bytes.readUInt32LE(24), samples: Float32Array.from({ length: count }, (_, n) => bytes.readInt16LE(chunk + 8 + 2 * n) / 32768) };
}

/** At the rate that pages have, by a windowed sinc. */
function resampled({ rate, samples }, wanted) {
  const ratio = rate / wanted;
  const half = 16;
  return Float32Array.from({ length: Math.floor(samples.length / ratio) }, (_, n) => {
    const middle = n * ratio;
    let sum = 0;
    for (let k = Math.ceil(middle - half); k <= middle + half; k += 1) {
      const x = k - middle;
      const sinc = x === 0 ? 1 : Math.sin(Math.PI * x) / (Math.PI * x);
      sum += (samples[k] ?? 0) * sinc * (0.5 + 0.5 * Math.cos((Math.PI * x) / half));
    }
    return sum;
  });
}

/** Events [ms, viseme] as the viseme of each frame. */
function framesOf(events, count) {
  const frames = new Int8Array(count);
  let now = 0;
  let next = 0;
  for (let n = 0; n < count; n += 1) {
    while (next < events.length && events[next][0] <= (n + 0.5) * step) now = events[next++][1];
    frames[n] = now;
  }
  return frames;
}

const { Listener } = await loadListener();
const library = await WebAssembly.compile(readFileSync(join(build, 'wasm/semblante_listen.wasm')));

/** Our listener is of TypeScript; esbuild is among the tools of web/. */
async function loadListener() {
  const esbuild = await import(pathToFileURL(join(root, 'web/node_modules/esbuild/lib/main.js')).href);
  const made = await esbuild.default.build({ entryPoints: [join(root, 'clients/js/listen/listener.ts')], bundle: true, format: 'esm', write: false });
  return import(`data:text/javascript;base64,${Buffer.from(made.outputFiles[0].contents).toString('base64')}`);
}

const strongest = (weights) => weights.indexOf(Math.max(...weights));

/** Each: viseme of each frame of a recording. */
const contestants = {
  'semblante, as a page hears it': ({ samples48 }, count) => {
    const frames = new Int8Array(count);
    new Listener(library, 48_000).push(samples48, ({ time, weights }) => {
      const n = Math.floor(time / step);
      if (n < count) frames[n] = strongest(weights);
    });
    return frames;
  },
};

if (packages && existsSync(join(packages, '@met4citizen/headaudio'))) {
  const folder = join(packages, '@met4citizen/headaudio');
  const { Processor } = await import(pathToFileURL(join(folder, 'modules/processor.mjs')).href);
  const { Training } = await import(pathToFileURL(join(folder, 'modules/training.mjs')).href);
  globalThis.fetch = async (path) => new Response(readFileSync(path));
  const order = ['aa', 'E', 'I', 'O', 'U', 'PP', 'SS', 'TH', 'DD', 'FF', 'kk', 'nn', 'RR', 'CH', 'sil'];
  const { model } = await new Training().loadModel(join(folder, 'dist/model-en-mixed.bin'));
  contestants.headaudio = ({ samples48 }, count) => {
    const events = [];
    let now = 0;
    const port = {
      postMessage: (data) => {
        if (data.event === 'viseme') events.push([now, names.indexOf(order[data.viseme])]);
        if (data.event === 'ended' || data.event === 'end') events.push([now, 0]);
      },
    };
    const processor = new Processor({ sampleRate: 48_000, processorOptions: { visemeEventsEnabled: true } }, { port });
    processor._onmessage({ data: { event: 'model', model } });
    for (let first = 0; first < samples48.length; first += 128) {
      now = (1000 * (first + 128)) / 48_000;
      processor.process(samples48.subarray(first, first + 128));
    }
    return framesOf(events, count);
  };
}

/** What AnalyserNode gives (Web Audio API, 1.8.6 and 1.8.7): Blackman's window, smoothing over time, dB as bytes. */
class Analyser {
  smoothed = null;
  constructor(samples) {
    this.samples = samples;
    this.end = 0;
  }
  set fftSize(size) {
    this.size = size;
    this.smoothed = new Float64Array(size / 2);
  }
  get frequencyBinCount() {
    return this.size / 2;
  }
  getByteFrequencyData(bytes) {
    const { size } = this;
    const re = new Float64Array(size);
    const im = new Float64Array(size);
    for (let n = 0; n < size; n += 1) {
      const x = n / size;
      re[n] = (this.samples[this.end - size + n] ?? 0) * (0.42 - 0.5 * Math.cos(2 * Math.PI * x) + 0.08 * Math.cos(4 * Math.PI * x));
    }
    fourier(re, im);
    for (let k = 0; k < size / 2; k += 1) {
      this.smoothed[k] = 0.8 * this.smoothed[k] + 0.2 * (Math.hypot(re[k], im[k]) / size);
      const dB = 20 * Math.log10(this.smoothed[k]);
      bytes[k] = Math.max(0, Math.min(255, Math.floor((255 / 70) * (dB + 100))));
    }
  }
}

function fourier(re, im) {
  const size = re.length;
  for (let i = 1, j = 0; i < size; i += 1) {
    let bit = size >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) [re[i], re[j]] = [re[j], re[i]];
  }
  for (let half = 1; half < size; half *= 2)
    for (let first = 0; first < size; first += 2 * half)
      for (let k = 0; k < half; k += 1) {
        const c = Math.cos((-Math.PI * k) / half);
        const s = Math.sin((-Math.PI * k) / half);
        const a = first + k;
        const b = a + half;
        const x = re[b] * c - im[b] * s;
        const y = re[b] * s + im[b] * c;
        [re[b], im[b]] = [re[a] - x, im[a] - y];
        [re[a], im[a]] = [re[a] + x, im[a] + y];
      }
}

if (packages && existsSync(join(packages, 'wawa-lipsync'))) {
  const { Lipsync } = await import(pathToFileURL(join(packages, 'wawa-lipsync/dist/wawa-lipsync.es.js')).href);
  // Its clock is the page's: here that of the recording, at 60 frames a second.
  contestants['wawa-lipsync'] = ({ samples48 }, count) => {
    const analyser = new Analyser(samples48);
    let now = 0;
    globalThis.window = { AudioContext: class { sampleRate = 48_000; createAnalyser = () => analyser; } };
    const clock = performance.now;
    performance.now = () => now;
    const lipsync = new Lipsync();
    const events = [];
    for (now = 0; now < (1000 * samples48.length) / 48_000; now += 1000 / 60) {
      analyser.end = Math.round(48 * now);
      lipsync.processAudio();
      events.push([now, names.indexOf(lipsync.viseme.replace('viseme_', ''))]);
    }
    performance.now = clock;
    return framesOf(events, count);
  };
}

/** The visemes of recordings whose label tracks `trackOf` makes, as rows [begin, end, IPA], s; null if it makes none. */
function labelsOfTracks(folder, trackOf) {
  const copy = mkdtempSync(join(tmpdir(), 'listen-'));
  for (const name of readdirSync(folder).filter((one) => one.endsWith('.wav'))) {
    const rows = trackOf(join(folder, name));
    if (!rows) return null;
    copyFileSync(join(folder, name), join(copy, name));
    writeFileSync(join(copy, name.replace('.wav', '.txt')), rows.map(([begin, end, ipa]) => `${begin}\t${end.toFixed(3)}\t${ipa}\n`).join(''));
  }
  const labels = labelsOf(copy);
  rmSync(copy, { recursive: true });
  return labels;
}

/** Phones by pocketsphinx without words, which knows English and the whole recording. */
function byPocketsphinx(folder) {
  const model = '/usr/share/pocketsphinx/model/en-us';
  if (!existsSync(model)) return null;
  const ipa = JSON.parse(execFileSync('python3', ['-c', 'import json; from cmu import CMU; print(json.dumps(CMU))'], { cwd: join(root, 'core/listen/train') }));
  return labelsOfTracks(folder, (path) => {
    const told = spawnSync('pocketsphinx_continuous', ['-infile', path, '-hmm', `${model}/en-us`, '-allphone', `${model}/en-us-phone.lm.bin`,
      '-time', 'yes', '-logfn', '/dev/null', '-remove_silence', 'no', '-lw', '2.0', '-beam', '1e-20', '-pbeam', '1e-20'], { encoding: 'utf8' });
    if (told.error) return null; // it is not installed
    const rows = told.stdout.split('\n').map((line) => line.trim().split(/\s+/)).filter((row) => row.length === 4);
    return rows.map(([phone, begin, end]) => [begin, Number(end) + 0.01, ipa[phone.toLowerCase()] ?? '']);
  });
}

/** Sounds of the words that semblante-recognizer-pocketsphinx hears. */
function byWords(folder) {
  const program = join(build, 'bin/semblante-recognizer-pocketsphinx');
  if (!existsSync(program)) return null;
  return labelsOfTracks(folder, (path) => {
    const { rate, samples } = readWav(path);
    const bytes = Buffer.from(Int16Array.from(samples, (value) => 32768 * value).buffer);
    const lines = [{ protocol: 1, name: 'recording', sample_rate: rate, language: 'en' }];
    for (let at = 0; at < bytes.length; at += 32_768) lines.push({ audio: bytes.subarray(at, at + 32_768).toString('base64') });
    lines.push({ end: true });
    const input = lines.map((line) => `${JSON.stringify(line)}\n`).join('');
    const answer = execFileSync(program, { input, encoding: 'utf8' }).trim().split('\n').map((line) => JSON.parse(line));
    const phones = answer.filter((line) => line.phoneme !== undefined);
    const end = samples.length / rate;
    return phones.map(({ phoneme, time }, n) => [time / 1000, n + 1 < phones.length ? phones[n + 1].time / 1000 : end, phoneme]);
  });
}

/** What lips tell apart, by viseme: rest, closed, lip on teeth, other consonants, open vowels, round vowels. */
const mouths = [0, 1, 2, 3, 3, 3, 3, 3, 3, 3, 4, 4, 4, 5, 5];

/** % of frames and of those of speech, at the delay, ms, that suits the contestant best. */
function score(labels, heard) {
  let best = { right: -1 };
  for (let delay = 0; delay <= 15; delay += 1) {
    let right = 0, all = 0, mouthRight = 0, speechRight = 0, speech = 0, lipsRight = 0, lips = 0;
    for (const [name, said] of labels) {
      const frames = heard.get(name);
      for (let n = 0; n < said.length; n += 1) {
        if (said[n] < 0) continue;
        const here = frames[Math.min(n + delay, said.length - 1)] ?? 0;
        const same = here === said[n];
        mouthRight += mouths[here] === mouths[said[n]];
        all += 1;
        right += same;
        if (said[n] === 0) continue;
        speech += 1;
        speechRight += same;
        if (said[n] !== 1) continue;
        lips += 1;
        lipsRight += same;
      }
    }
    if (right / all > best.right) best = { right: right / all, mouth: mouthRight / all, speech: speechRight / speech, lips: lipsRight / lips, delay: delay * step };
  }
  return best;
}

const percent = (value) => `${(100 * value).toFixed(1).padStart(5)} %`;
for (const folder of sets) {
  const labels = labelsOf(folder);
  const recordings = new Map([...labels.keys()].map((name) => [name, { samples48: resampled(readWav(join(folder, name)), 48_000) }]));
  console.log(`\n${basename(folder)}: ${labels.size} recordings, ${([...labels.values()].reduce((sum, one) => sum + one.length, 0) / 100).toFixed(0)} s`);
  console.log(`${'by'.padEnd(32)} frames  of speech  mouths   p b m    at a delay of`);
  const tell = (name, heard) => {
    const { right, mouth, speech, lips, delay } = score(labels, heard);
    console.log(`${name.padEnd(32)} ${percent(right)}  ${percent(speech)}  ${percent(mouth)}  ${percent(lips)}  ${delay} ms`);
  };
  for (const [name, hear] of Object.entries(contestants))
    tell(name, new Map([...recordings].map(([file, sound]) => [file, hear(sound, labels.get(file).length)])));
  tell('silence', new Map([...labels].map(([file, said]) => [file, new Int8Array(said.length)])));
  for (const [name, hear] of [['recognizer, words', byWords], ['pocketsphinx, phones', byPocketsphinx]]) {
    const heard = hear(folder);
    if (heard) tell(name, heard);
  }
}

import { execFileSync, spawn } from 'node:child_process';
import { cpSync, mkdtempSync, rmSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { buildDir, sampleHead, webRoot } from './paths.ts';
import { eventually } from './patience.ts';

/** The variable with the folder of `prepareData`; without it each server parametrizes its sample head, which takes seconds. */
export const preparedData = 'SEMBLANTE_PREPARED_DATA';

export interface RunningServer {
  url: string;
  token: string;
  /** Kills it without a word, and starts it again with the same data on the same port. */
  restart(): Promise<void>;
  stop(): Promise<void>;
}

/** A free port below the ephemeral range of outgoing connections. */
async function freePort(): Promise<number> {
  for (let tries = 0; tries < 50; tries += 1) {
    const port = 18_000 + Math.floor(Math.random() * 12_000);
    const free = await new Promise<boolean>((resolve) => {
      const probe = createServer();
      probe.once('error', () => resolve(false));
      probe.listen(port, '127.0.0.1', () => probe.close(() => resolve(true)));
    });
    if (free) return port;
  }
  throw new Error('no free port');
}

/** A token of a data folder that no server uses yet. */
function makeToken(data: string, scope: string): string {
  return execFileSync(join(buildDir, 'bin/semblante'), ['token', 'create', '--data', data, '--scope', scope], {
    encoding: 'utf8',
    stdio: ['ignore', 'pipe', 'ignore'],
  }).trim();
}

export interface ServerOptions {
  /** It asks for tokens, and `token` is one of this scope. */
  tokenScope?: string;
  /** The folder that it serves. */
  pages?: string;
  /** Whether it has the demo stream. */
  demo?: boolean;
  /** The program that speaks. */
  voice?: string;
  /** Origins beside its own whose pages may use it; "*": all. */
  allowOrigin?: string;
}

interface Started {
  /** Resolves once it has ended. */
  kill(signal: NodeJS.Signals): Promise<void>;
}

/** Starts the server at a port, on a data folder; resolves once its sample head can be animated. */
async function start(port: number, data: string, token: string, { pages = webRoot, demo = true, voice = 'none', allowOrigin }: ServerOptions): Promise<Started> {
  const url = `http://127.0.0.1:${port}`;
  const headers: Record<string, string> = token === '' ? {} : { Authorization: `Bearer ${token}` };
  const child = spawn(
    join(buildDir, 'bin/semblante'),
    ['serve', '--port', String(port), '--data', data, '--web-root', pages, '--sample', sampleHead, '--voice-program', voice, ...(demo ? ['--demo'] : []), ...(allowOrigin === undefined ? [] : ['--allow-origin', allowOrigin]), ...(token === '' ? [] : ['--require-tokens'])],
    { stdio: ['ignore', 'pipe', 'pipe'] },
  );
  let output = '';
  child.stdout.on('data', (chunk: Buffer) => (output += chunk.toString()));
  child.stderr.on('data', (chunk: Buffer) => (output += chunk.toString()));
  const ended = new Promise<void>((resolve) => child.once('exit', () => resolve()));
  await eventually('the server is ready', async () => {
    if (child.exitCode !== null) throw new Error(`the server stopped while starting:\n${output}`);
    const ready = await fetch(`${url}/readyz`).then(
      (r) => r.ok,
      () => false,
    );
    return (
      ready &&
      (await fetch(`${url}/v1/models/sample`, { headers }).then(
        async (r) => r.ok && ((await r.json()) as { state: string }).state === 'parametrized',
        () => false,
      ))
    );
  });
  return {
    kill: (signal) => {
      child.kill(signal);
      return ended;
    },
  };
}

const newFolder = (): string => mkdtempSync(join(tmpdir(), 'semblante-browser-'));

/** The data folder of a server that has imported and parametrized the sample head, for the servers of all test files. */
export async function prepareData(): Promise<string> {
  const data = newFolder();
  const server = await start(await freePort(), data, '', { demo: false });
  await server.kill('SIGTERM');
  return data;
}

/** Starts the real server with the sample head and the demo stream, and nothing else in its store; resolves once it is ready. */
export async function startServer(options: ServerOptions = {}): Promise<RunningServer> {
  const { tokenScope } = options;
  const port = await freePort();
  const data = newFolder();
  const prepared = process.env[preparedData];
  if (prepared) cpSync(prepared, data, { recursive: true });
  const token = tokenScope === undefined ? '' : makeToken(data, tokenScope);
  let running = await start(port, data, token, options);
  return {
    url: `http://127.0.0.1:${port}`,
    token,
    restart: async () => {
      await running.kill('SIGKILL');
      running = await start(port, data, token, options);
    },
    stop: async () => {
      await running.kill('SIGTERM');
      rmSync(data, { recursive: true, force: true });
    },
  };
}

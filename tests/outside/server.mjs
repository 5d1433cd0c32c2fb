// A real server with an empty store for one test file.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = fileURLToPath(new URL('../../', import.meta.url));
const voice = join(root, 'server/voice/examples/beeps.py');
export const buildDir = resolve(process.env.SEMBLANTE_BUILD ?? join(root, 'build'));

/** Starts `semblante serve` on a free port; resolves with its address and a function that stops it. */
export async function startServer() {
  const data = mkdtempSync(join(tmpdir(), 'semblante-outside-'));
  const child = spawn(join(buildDir, 'bin/semblante'), ['serve', '--port', '0', '--data', data, '--voice-program', voice], {
    stdio: ['ignore', 'pipe', 'inherit'],
  });
  const ended = new Promise((done) => child.once('exit', done));
  const url = await new Promise((done, fail) => {
    let output = '';
    child.once('error', fail);
    child.once('exit', (code) => fail(new Error(`the server ended with ${code} before it listened`)));
    child.stdout.on('data', (chunk) => {
      output += chunk;
      const address = /semblante listening on (http:\S+)\n/.exec(output);
      if (address) done(address[1]);
    });
  });
  const stop = async () => {
    child.kill('SIGTERM');
    await ended;
    rmSync(data, { recursive: true, force: true });
  };
  return { url, stop };
}

import { execFile } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { promisify } from 'node:util';
import type { Page } from 'playwright-core';
import { afterAll, beforeAll, expect } from 'vitest';
import { buildDir, root } from './paths.ts';
import { patience } from './patience.ts';
import { startServer, type RunningServer } from './server.ts';
import { browser, useBrowser } from './suite.ts';

/** Does not block: the runner asks for signs of life. */
export const run = promisify(execFile);

/** A project of a stranger, with the packed package in node_modules. */
export let project: string;
export let unpacked: string;
export let server: RunningServer;

/** Gives the tests of a file the project, a server of its pages and a browser, and removes them after. */
export function usePackedPackage(): void {
  useBrowser();
  beforeAll(async () => {
    project = mkdtempSync(join(tmpdir(), 'semblante-npm-'));
    const folder = join(project, 'made');
    const environment = { ...process.env, SEMBLANTE_BUILD: buildDir };
    await run(process.execPath, [join(root, 'clients/js/build.mjs'), folder], { env: environment });
    const pack = ['pack', '--silent', '--ignore-scripts', '--pack-destination', project];
    const { stdout: packed } = await run('npm', pack, { cwd: folder });
    unpacked = join(project, 'node_modules/semblante');
    mkdirSync(unpacked, { recursive: true });
    await run('tar', ['-xzf', join(project, packed.trim().split('\n').at(-1)!), '--strip-components=1', '-C', unpacked]);
    writeFileSync(join(project, 'package.json'), '{"type":"module","private":true}');
    server = await startServer({ pages: project, voice: join(buildDir, 'bin/semblante-voice-espeak') });
  });
  afterAll(async () => {
    await server?.stop();
    rmSync(project, { recursive: true, force: true });
  });
}

/** Opens a page of the project, which the real server serves, waits until its face moves, and does more with it. */
export async function moves(path: string, origin = server.url, more?: (page: Page) => Promise<void>): Promise<void> {
  const page = await browser.newPage();
  try {
    page.setDefaultTimeout(patience);
    const errors: string[] = [];
    page.on('pageerror', (error) => errors.push(String(error)));
    page.on('console', (message) => {
      if (message.type() === 'error' && !message.location().url.endsWith('/favicon.ico')) errors.push(message.text());
    });
    await page.goto(origin + path, { timeout: patience });
    await page.waitForFunction(() => (document.querySelector('semblante-face') as { state?: string } | null)?.state === 'playing');
    await more?.(page).catch((error: unknown) => {
      expect(errors).toEqual([]); // tells more
      throw error;
    });
    expect(errors).toEqual([]);
  } finally {
    await page.close();
  }
}

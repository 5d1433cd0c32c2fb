import { spawn, type ChildProcess } from 'node:child_process';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { buildDir } from './paths.ts';
import type { RunningServer } from './server.ts';

/** semblante-test-proxy before a server. */
export class BadNetwork {
  private constructor(
    private readonly proxy: ChildProcess,
    /** Of the server behind it. */
    readonly address: string,
  ) {}

  /** `kind`: words of semblante-test-proxy, such as "delay=20". */
  static async before(server: RunningServer, kind: readonly string[]): Promise<BadNetwork> {
    const proxy = spawn(join(buildDir, 'bin/semblante-test-proxy'), [new URL(server.url).port, ...kind], {
      stdio: ['pipe', 'pipe', 'inherit'],
    });
    const port = await new Promise<string>((resolve, reject) => {
      createInterface({ input: proxy.stdout! }).once('line', resolve);
      proxy.once('error', reject);
      proxy.once('exit', (code) => reject(new Error(`the proxy ended with exit code ${code}`)));
    });
    return new BadNetwork(proxy, `http://127.0.0.1:${port}`);
  }

  /** "cut", "refuse" or "accept". */
  tell(...commands: string[]): void {
    this.proxy.stdin!.write(commands.map((command) => `${command}\n`).join(''));
  }

  close(): void {
    this.proxy.kill();
  }
}

import { createServer, request as ask, type IncomingMessage, type Server } from 'node:http';
import { connect, type AddressInfo } from 'node:net';
import type { RunningServer } from './server.ts';

/** A proxy under which a server lies below a path, as `location /faces/ { proxy_pass http://server/; }` of nginx. */
export class SubPath {
  private constructor(
    private readonly proxy: Server,
    /** Of the server behind it, with the path. */
    readonly address: string,
    /** What was asked of the proxy outside of the path. */
    readonly strays: string[],
  ) {}

  static async before(server: RunningServer, path: string): Promise<SubPath> {
    const { port } = new URL(server.url);
    const strays: string[] = [];
    const inner = (request: IncomingMessage): string | null => {
      const url = request.url ?? '';
      if (url.startsWith(`${path}/`)) return url.slice(path.length);
      strays.push(url);
      return null;
    };
    const proxy = createServer((request, answer) => {
      const target = inner(request);
      if (target === null) return answer.writeHead(404).end();
      const passed = ask({ port, host: '127.0.0.1', path: target, method: request.method, headers: request.headers }, (response) => {
        answer.writeHead(response.statusCode!, response.headers);
        response.pipe(answer);
      });
      passed.on('error', () => answer.destroy());
      answer.on('close', () => passed.destroy());
      request.pipe(passed);
    });
    proxy.on('upgrade', (request, client) => {
      const target = inner(request);
      if (target === null) return client.destroy();
      const upstream = connect(Number(port), '127.0.0.1', () => {
        const fields = request.rawHeaders.flatMap((name, at, all) => (at % 2 === 0 ? [`${name}: ${all[at + 1]}`] : []));
        upstream.write(`${[`GET ${target} HTTP/1.1`, ...fields].join('\r\n')}\r\n\r\n`);
        upstream.pipe(client).pipe(upstream);
      });
      upstream.on('error', () => client.destroy());
      client.on('error', () => upstream.destroy());
    });
    await new Promise<void>((resolve) => proxy.listen(0, '127.0.0.1', resolve));
    return new SubPath(proxy, `http://127.0.0.1:${(proxy.address() as AddressInfo).port}${path}`, strays);
  }

  close(): void {
    this.proxy.closeAllConnections();
    this.proxy.close();
  }
}

import { execFile } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { expect, test } from 'vitest';

test('ApiTypes_GeneratedAgain_AreThoseInTheTree', async () => {
  const web = fileURLToPath(new URL('..', import.meta.url));
  const check = promisify(execFile)('npm', ['run', '--silent', 'types', '--', '--check'], { cwd: web });
  await expect(check, 'server/api/openapi.json has changed: npm run types').resolves.toBeDefined();
});

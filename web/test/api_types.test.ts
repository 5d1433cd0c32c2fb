import { execFileSync } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';

test('ApiTypes_GeneratedAgain_AreThoseInTheTree', () => {
  const web = fileURLToPath(new URL('..', import.meta.url));
  const check = (): void =>
    void execFileSync('npm', ['run', '--silent', 'types', '--', '--check'], { cwd: web, stdio: 'pipe' });
  expect(check, 'server/api/openapi.json has changed: npm run types').not.toThrow();
});

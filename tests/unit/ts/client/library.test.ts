import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { describe, expect, it, vi } from 'vitest';
import { bytesOf } from '../../../../clients/js/wasm.ts';
import * as layouts from '../../../../clients/js/generated/layouts.ts';
import { listenPath, motionPath, speakPath, viewPath, wholePath } from '../support/runtime.ts';

const root = fileURLToPath(new URL('../../../..', import.meta.url));

/** "timedFrameLayout" -> "semblante_timed_frame". */
const structName = (layout: string): string =>
  `semblante_${layout.replace(/Layout$/, '').replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`)}`;

describe('bytesOf', () => {
  const answer = async (response: Response): Promise<string> => {
    const fetched = vi.spyOn(globalThis, 'fetch').mockResolvedValue(response);
    try {
      return await bytesOf(new URL('http://page/x.wasm')).then(({ length }) => `${length} bytes`, String);
    } finally {
      fetched.mockRestore();
    }
  };

  it('FileThatTheBundlerLeftBehind_SaysWhereToRead', async () => {
    expect(await answer(new Response(new Uint8Array([0, 0x61, 0x73, 0x6d, 1])))).toBe('5 bytes');
    const hint = 'The bundler has left this file behind: see "Bundlers" in the README of semblante';
    expect(await answer(new Response('<!doctype html>'))).toBe(`Error: http://page/x.wasm: a page, not WebAssembly. ${hint}`);
    expect(await answer(new Response('', { status: 404 }))).toBe(`Error: http://page/x.wasm: status 404. ${hint}`);
  });
});

describe('libsemblante in WebAssembly', () => {
  it.each([
    ['semblante_view.wasm: streams, players and the kernel', viewPath, 87_900, 39_600],
    ['semblante_speak.wasm: speakers', speakPath, 23_700, 14_700],
    ['semblante_motion.wasm: takes, performances and bridges', motionPath, 109_400, 51_500],
    ['semblante_listen.wasm: listeners', listenPath, 56_700, 48_700],
    ['semblante.wasm: everything but listeners', wholePath, 239_900, 110_100],
  ])('%s has no imports and is as small as this', async (_, path, bytes, gzipped) => {
    const file = readFileSync(path);
    const module = await WebAssembly.compile(file);
    expect(WebAssembly.Module.imports(module)).toEqual([]);
    expect(file.length).toBeLessThanOrEqual(bytes);
    expect(gzipSync(file, { level: 9 }).length).toBeLessThanOrEqual(gzipped);
  });

  it('semblante.wasm and semblante_listen.wasm export the functions of the header', async () => {
    const modules = await Promise.all([wholePath, listenPath].map((path) => WebAssembly.compile(readFileSync(path))));
    const exported = new Set(modules.flatMap((module) => WebAssembly.Module.exports(module)).map(({ name }) => name));
    const listed = readFileSync(join(root, 'clients/runtime/exports.map'), 'utf8').match(/semblante_\w+(?=;)/g)!;
    expect(listed.filter((name) => !exported.has(name)).sort()).toEqual([
      // Parts of what semblante_head_positions does, which pages have by semblante_deform_changed.
      'semblante_deform',
      'semblante_deform_prepared',
      'semblante_prepare', // semblante_prepare_for, without a rig
      'semblante_sincos',
    ]);
  });

  it('The layouts of the binding are the compiler\'s', () => {
    const clang = ['clang-14', 'clang-15', 'clang-16', 'clang-17', 'clang-18', 'clang-19', 'clang'].find((name) =>
      process.env['PATH']!.split(':').some((folder) => existsSync(join(folder, name))),
    );
    expect(clang).toBeDefined();
    const checks = Object.entries(layouts).flatMap(([layout, { bytes, ...members }]) => {
      const name = structName(layout);
      return [
        `_Static_assert(sizeof(${name}) == ${bytes}, "${name}");`,
        ...Object.entries(members).map(([member, at]) => `_Static_assert(__builtin_offsetof(${name}, ${member}) == ${at}, "${name}.${member}");`),
      ];
    });
    expect(checks.length).toBeGreaterThan(150);
    const folder = mkdtempSync(join(tmpdir(), 'semblante-layouts-'));
    try {
      const source = join(folder, 'layouts.c');
      writeFileSync(source, `#include "clients/runtime/semblante.h"\n${checks.join('\n')}\n`);
      execFileSync(clang!, ['--target=wasm32-wasi', '-std=c11', '-fsyntax-only', '-I', root, source], { stdio: 'pipe' });
    } finally {
      rmSync(folder, { recursive: true });
    }
  });
});

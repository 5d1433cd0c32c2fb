import { readFileSync } from 'node:fs';
import { afterEach, describe, expect, test, vi } from 'vitest';
import { adviceFor, featurePointOf, fieldProblems, problemFrom, problemOf, titleOf, wordsOf } from '../src/net/problem.ts';
import type { Problem } from '../src/net/types.ts';

afterEach(() => {
  vi.unstubAllGlobals();
  vi.resetModules();
});

describe('problem documents', () => {
  const refused = { type: '/problems/malformed-model', title: 'The model file cannot be read', status: 422, detail: 'line 3: no number' };

  test('Words_InEnglish_AreTheDetail', () => {
    expect([titleOf(refused), wordsOf(refused)]).toEqual([refused.title, refused.detail]);
    expect(wordsOf({ type: 'about:blank', title: 'Bad Gateway', status: 502 })).toBe('Bad Gateway');
  });

  test('Words_InPortuguese_AreTheDetailOrBeginWithTheTitleByItsCode', async () => {
    vi.stubGlobal('navigator', { languages: ['pt-BR'] });
    vi.resetModules();
    const there = await import('../src/net/problem.ts');
    expect(await (await import('../src/words/words.ts')).loadServerWords()).toBe(true);
    const title = 'O arquivo do modelo não pode ser lido';
    expect([there.titleOf(refused), there.wordsOf(refused)]).toEqual([title, `${title}: line 3: no number`]);
    expect(there.wordsOf({ ...refused, detail: 'the file has no triangles' })).toBe('o arquivo não tem triângulos');
    const errors = [{ pointer: '/points/2.1', detail: 'point 2.1 is given twice' }, { pointer: '/points/2.2', detail: 'another fault' }];
    expect(there.fieldProblems({ ...refused, errors })).toEqual([{ pointer: '/points/2.1', detail: 'o ponto 2.1 foi dado duas vezes' }, errors[1]]);
    // A title of this page, or of a proxy, is not the server's.
    expect(there.wordsOf({ type: 'about:blank', title: 'Bad Gateway', status: 502, detail: 'none' })).toBe('none');
  });

  /** The names as the server has them, from their source. */
  const named = [...readFileSync(new URL('../../core/types/advice.cpp', import.meta.url), 'utf8').matchAll(/\{Advice::\w+, "([a-z-]+)"/g)].map(([, name]) => name as Problem['advice'] & string);

  test('Advice_OfEveryName_HasItsOwnWordsInEachLanguage', async () => {
    expect(named.length).toBeGreaterThan(10);
    const english = named.map((advice) => adviceFor({ ...refused, advice }));
    vi.stubGlobal('navigator', { languages: ['pt-BR'] });
    vi.resetModules();
    const there = await import('../src/net/problem.ts');
    const portuguese = named.map((advice) => there.adviceFor({ ...refused, advice }));
    for (const words of [english, portuguese]) {
      expect(words).not.toContain(null);
      expect(new Set(words).size).toBe(named.length);
    }
    expect(portuguese.filter((words) => english.includes(words))).toEqual([]);
  });

  test('Advice_OfARefusedFile_IsWhatTheServerNames_WhateverItSays', () => {
    const packed = { type: '/problems/unsupported-media-type', title: 'no', status: 415, detail: 'the file is packed (RAR): send it', advice: 'unpack' } as const;
    expect(adviceFor(packed)).toContain('Unpack it');
    expect(adviceFor({ ...packed, advice: 'export-as-glb' })).toContain('Blender');
    expect(adviceFor({ ...refused, advice: 'reduce-model' })).toContain('Reduce the mesh');
    expect(adviceFor({ ...refused, advice: 'of-a-newer-server' } as unknown as Problem)).toBeNull();
  });

  test('Advice_OfAStoredFaultOfAnEarlierVersion_IsWhatItsDetailSays', () => {
    expect(adviceFor({ ...refused, detail: "the zip has no model but 'inner.zip': send the model that is in it" })).toBeNull();
    expect(adviceFor({ type: '/problems/limit-exceeded', title: 'no', status: 507, detail: 'the server has reached its limit of 9 models' })).toBeNull();
  });

  test('Advice_WithoutTheServersWord_IsThatOfTheStatus', () => {
    const of = (status: number): string | null => adviceFor({ type: 'about:blank', title: 'x', status });
    expect([of(0), of(404), of(413), of(503), of(429)].map((words) => words?.slice(0, 13))).toEqual(['Check that th', 'It may have b', 'Reduce the me', 'The server is', 'The server is']);
    expect([of(502), of(-1), of(500)]).toEqual([null, null, null]);
  });

  test('ProblemFrom_ProblemJson_KeepsItsMembers', () => {
    const body = JSON.stringify({
      type: '/problems/invalid-feature-point',
      title: 'Refused',
      status: 422,
      detail: 'no such vertex',
      pointer: '/points/2.1/vertex',
    });
    expect(problemFrom(422, 'Unprocessable', 'application/problem+json', body)).toMatchObject({
      pointer: '/points/2.1/vertex',
      detail: 'no such vertex',
    });
  });

  test('ProblemOf_APartOfThePageThatIsGone_AsksToReload', () => {
    expect(problemOf(new TypeError('Failed to fetch dynamically imported module: http://127.0.0.1/assets/a.js')).detail).toContain('Reload the page');
    expect(problemOf(new TypeError('error loading dynamically imported module: a.js')).detail).toContain('Reload the page');
  });

  test('ProblemFrom_HtmlOfAProxy_ShowsNoMarkup', () => {
    expect(problemFrom(502, 'Bad Gateway', 'text/html', '<html>..</html>')).toEqual({
      type: 'about:blank',
      title: 'Bad Gateway',
      status: 502,
    });
  });

  test('ProblemFrom_CutShortJson_StillIsAProblem', () => {
    expect(problemFrom(500, '', 'application/problem+json', '{"title":').title).toBe('HTTP 500');
  });

  test('FieldProblems_SeveralErrors_GivesEach', () => {
    const errors = [
      { pointer: '/points/2.1', detail: 'a' },
      { pointer: '/points/9.3/vertex', detail: 'b' },
    ];
    expect(fieldProblems({ type: '', title: 'x', status: 422, errors })).toEqual(errors);
  });

  test('FeaturePointOf_PointerIntoAPoint_NamesIt', () => {
    expect(featurePointOf('/points/2.10/vertex')).toBe('2.10');
    expect(featurePointOf('/points/7.1')).toBe('7.1');
  });

  test('FeaturePointOf_AnythingElse_IsNull', () => {
    expect([featurePointOf('/name'), featurePointOf(undefined), featurePointOf('/points/abc/vertex')]).toEqual([
      null,
      null,
      null,
    ]);
  });
});

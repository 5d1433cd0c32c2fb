import { readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import ts from 'typescript';
import { expressions, faps, featurePointNames, visemes } from '@protocol/generated/mpeg4.ts';
import { expect, test } from 'vitest';
import { lengthUnits } from '../src/face/unit_measures.ts';
import { capital, fapTitle } from '../src/ui/shared/names.ts';
import { portuguese } from '../src/words/portuguese.ts';
import { portugueseFindings, portugueseMeasure } from '../src/words/portuguese_findings.ts';
import { portugueseNames, portugueseVisemeWords } from '../src/words/portuguese_names.ts';
import { portugueseProblems } from '../src/words/portuguese_problems.ts';
import { languageOf, t } from '../src/words/words.ts';

const source = fileURLToPath(new URL('../src', import.meta.url));
const files = (readdirSync(source, { recursive: true, encoding: 'utf8' }) as string[])
  .filter((name) => name.endsWith('.ts') && !/generated|^words/.test(name))
  .map((name) => join(source, name));

/** Folders whose strings are addresses, methods, drawings and programs for the graphics card. */
const withoutTexts = /^(face\/(?!feature_points|quick_set)|net\/(?!live|problem|http|upload)|view\/|main\.ts|ui\/(page\/inspect|shared\/icons|animate\/expression_face))/;
/** Parts of the standard's names, commands and names of protocols, which are the same in every language. */
const notTexts = new Set(['Semblante', 'left of middle', 'right of middle', 'lip middle', 'lip corner', 'lip corners', 'semblante token create', 'ApiError', 'Content-Type']);
/** `example`: a text of a spoken language, which is not the page's. */
const silentProperties = new Set(['class', 'type', 'role', 'id', 'method', 'autocomplete', 'example']);
const silentCalls = /(querySelector(All)?|closest|addEventListener|classList\.\w+|getAttribute|includes|replaceAll|split|join|matchMedia|heatGradient|svg|kbd|Error|DOMException)$/;

const looksLikeText = (text: string): boolean =>
  /\p{L}{3}/u.test(text) && (/^[“"(]?[A-Z][a-z ]/.test(text) || /[a-z,:.] [a-z{]/.test(text));

/** The English of a literal, with `{}` for what is filled in; null for other nodes. */
function literal(node: ts.Node): string | null {
  if (ts.isStringLiteral(node) || ts.isNoSubstitutionTemplateLiteral(node)) return node.text;
  if (!ts.isTemplateExpression(node)) return null;
  return node.head.text + node.templateSpans.map((span) => `{}${span.literal.text}`).join('');
}

/** Whether a literal is no text because of where it stands. */
function isSilent(node: ts.Node): boolean {
  const { parent } = node;
  if (ts.isLiteralTypeNode(parent) || ts.isImportDeclaration(parent) || ts.isExportDeclaration(parent)) return true;
  if (ts.isElementAccessExpression(parent) || ts.isCaseClause(parent)) return true;
  if (ts.isPropertyAssignment(parent) && parent.name === node) return true;
  if (ts.isBinaryExpression(parent) && /^[!=]==$/.test(parent.operatorToken.getText())) return true;
  for (let at = node; at.parent; at = at.parent) {
    const above = at.parent;
    if (ts.isPropertyAssignment(above)) {
      const name = above.name.getText().replaceAll("'", '');
      return silentProperties.has(name) || name.startsWith('data-') || /^[A-Z]/.test(name);
    }
    if ((ts.isCallExpression(above) || ts.isNewExpression(above)) && above.arguments?.includes(at as ts.Expression)) {
      const name = above.expression.getText();
      return name === 't' || name === 'nameOf' || silentCalls.test(name) || (name.endsWith('headers.get') || name.endsWith('setRequestHeader') || name.endsWith('getResponseHeader'));
    }
    if (ts.isBlock(above)) return false;
  }
  return false;
}

function findings(): { outside: string[]; used: Set<string> } {
  const outside: string[] = [];
  const used = new Set<string>();
  for (const file of files) {
    const code = ts.createSourceFile(file, readFileSync(file, 'utf8'), ts.ScriptTarget.Latest, true);
    const name = relative(source, file);
    const visit = (node: ts.Node): void => {
      const text = literal(node);
      if (text !== null && ts.isCallExpression(node.parent) && node.parent.expression.getText() === 't') used.add(text);
      else if (text !== null && !withoutTexts.test(name) && looksLikeText(text) && !notTexts.has(text) && !isSilent(node))
        outside.push(`${name}:${code.getLineAndCharacterOfPosition(node.getStart()).line + 1}: ${text}`);
      if (text === null || ts.isTemplateExpression(node)) ts.forEachChild(node, visit);
    };
    visit(code);
  }
  return { outside, used };
}

const found = findings();

test('Words_StringsOfThePage_AreAllInTheTables', () => expect(found.outside).toEqual([]));

test('Words_TextsOfTheTables_AreAllUsed', () =>
  expect(Object.keys(portuguese).filter((text) => !found.used.has(text))).toEqual([]));

test('Words_Translation_FillsInTheSameValues', () => {
  const values = (text: string): string[] => (text.match(/\{\w+\}/g) ?? []).sort();
  for (const [english, text] of Object.entries(portuguese)) {
    expect(values(text), english).toEqual(values(english));
    expect([text.startsWith(' '), text.endsWith(' ')], english).toEqual([english.startsWith(' '), english.endsWith(' ')]);
  }
});

test('Words_NamesOfTheStandard_AllHaveATranslation', () => {
  const names = [
    ...featurePointNames,
    ...faps.map(({ name, group }) => fapTitle(name, group)),
    ...lengthUnits.map(({ meaning }) => meaning),
    ...expressions.slice(1).flatMap(({ name, description }) => [capital(name), description]),
  ];
  expect(names.filter((name) => portugueseNames[name] === undefined)).toEqual([]);
});

test('Words_Visemes_HaveWordsOfTheirOwnButForSoundsThatTheLanguageLacks', () => {
  expect(Object.keys(portugueseVisemeWords)).toEqual(visemes.map(({ name }) => name));
  const english = visemes.filter(({ name, examples }) => examples.some((word) => portugueseVisemeWords[name]!.includes(word)));
  expect(english.map(({ name }) => name)).toEqual(['th']);
  for (const { name, phonemes } of visemes) expect(portugueseVisemeWords[name]!.length > 0, name).toBe(phonemes.length > 0);
});

test('Words_ProblemsOfTheServer_AllHaveATitle', () => {
  const server = readFileSync(new URL('../../server/http/problem.cpp', import.meta.url), 'utf8');
  const slugs = [...server.matchAll(/^ {4}\{"([a-z-]+)", \d{3}, "/gm)].map((match) => match[1]!);
  expect(slugs).toContain('malformed-model');
  expect(Object.keys(portugueseProblems).sort()).toEqual(slugs.sort());
});

test('Words_Values_AreFilledIn', () => {
  expect(t('Point {step} of {count}', { step: 3, count: 20 })).toBe('Point 3 of 20');
  expect(t('{name} was deleted.', { name: '{name} $&' })).toBe('{name} $& was deleted.');
  expect(t('Delete {name}?', { name: 'رأس 2' })).toBe('Delete \u2068رأس 2\u2069?');
});

test('Words_LanguagesOfABrowser_FirstKnownOneIsTaken', () => {
  expect(languageOf(['de-DE', 'pt-PT', 'en'])).toBe('pt-BR');
  expect(languageOf(['en-GB', 'pt-BR'])).toBe('en');
  expect(languageOf(['fr', 'ptx'])).toBe('en');
  expect(languageOf([])).toBe('en');
});

/** The names between the braces of `array` in a file of the server. */
const stringsOf = (file: string, array: RegExp): string[] => {
  const text = readFileSync(new URL(`../../core/doctor/${file}`, import.meta.url), 'utf8');
  return [...array.exec(text)![0].matchAll(/"([^"]+)"/g)].map(([, name]) => name!);
};

test('Every finding of the server has its texts in Portuguese', () => {
  const codes = stringsOf('finding.h', /finding_code_names = [^;]*/);
  expect(codes.length).toBeGreaterThan(30);
  expect(Object.keys(portugueseFindings).sort()).toEqual([...codes].sort());
  for (const code of codes) {
    for (const points of [['2.2', '3.1'], ['3.6'], []]) {
      const texts = portugueseFindings[code]!({ points, count: points.length, value: 0.25, what: 'MW', vertex: points.length ? 7 : null });
      expect(texts).toHaveLength(2);
      for (const text of texts) expect(text).not.toMatch(/undefined|null|NaN|\bthe\b|[.]$|  /);
    }
  }
});

test('What findings measure has its name in Portuguese', () => {
  const folder = new URL('../../core/doctor/', import.meta.url);
  const measures = readdirSync(folder)
    .filter((name) => name.endsWith('.cpp'))
    .flatMap((name) => [...readFileSync(new URL(name, folder), 'utf8').matchAll(/measured = \{\s*"([^"]+)"/g)].map(([, what]) => what!));
  expect(measures.length).toBeGreaterThan(15);
  for (const what of measures) expect(portugueseMeasure(what), what).not.toBe(what);
  expect(portugueseMeasure('MW as a fraction of ES0')).toBe('MW como fração de ES0');
});

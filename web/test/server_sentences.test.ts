import { readdirSync, readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { portugueseDetails } from '../src/words/portuguese_details.ts';
import { portugueseRemarks } from '../src/words/portuguese_remarks.ts';
import { sentenceTranslator } from '../src/words/server_sentences.ts';

const root = new URL('../../', import.meta.url);
const sourcesIn = (folder: string): string[] =>
  (readdirSync(new URL(folder, root), { recursive: true, encoding: 'utf8' }) as string[])
    .filter((name) => /\.(cpp|h)$/.test(name) && !name.includes('generated'))
    .map((name) => readFileSync(new URL(`${folder}/${name}`, root), 'utf8').replace(/^\s*(\/\/|#include).*$/gm, ''));

/** The string literals of C++ text in their order; those side by side are one, as for the compiler. */
function literalsOf(code: string): string[] {
  const literals: string[] = [];
  let end = -1;
  for (const match of code.matchAll(/"((?:[^"\\\n]|\\.)*)"|'(?:[^'\\\n]|\\.)'/g)) {
    if (match[1] === undefined) continue;
    const text = match[1].replace(/\\(.)/g, '$1');
    if (end >= 0 && code.slice(end, match.index).trim() === '') literals.push(literals.pop()! + text);
    else literals.push(text);
    end = match.index + match[0].length;
  }
  return literals;
}

/** Whether a text is put together from whole literals. */
function isMadeOf(text: string, literals: ReadonlySet<string>): boolean {
  const reached = new Set([0]);
  for (let from = 0; from < text.length; from += 1) {
    if (!reached.has(from)) continue;
    for (const one of literals) if (one !== '' && text.startsWith(one, from)) reached.add(from + one.length);
  }
  return reached.has(text.length);
}

const piecesOf = (english: string): string[] => english.split(/\{\w+\}/).filter((piece) => piece !== '');

const files = ['core', 'server', 'protocol/cpp'].flatMap(sourcesIn).map((code) => new Set(literalsOf(code)));

test.each([
  ['remark', portugueseRemarks],
  ['detail', portugueseDetails],
])('Sentences_Every%s_IsOneThatTheServerSays', (_, table) => {
  const said = (english: string): boolean => files.some((literals) => piecesOf(english).every((piece) => isMadeOf(piece, literals)));
  expect(Object.keys(table).filter((english) => !said(english))).toEqual([]);
});

/** What follows an opening bracket, up to the one that closes it. */
function insideBrackets(code: string, from: number): string {
  let depth = 1;
  let at = from;
  while (depth > 0 && at < code.length) {
    if (code[at] === '"') at += /^"(?:[^"\\]|\\.)*"/.exec(code.slice(at))![0].length - 1;
    else if (code[at] === '(') depth += 1;
    else if (code[at] === ')') depth -= 1;
    at += 1;
  }
  return code.slice(from, at - 1);
}

test('Sentences_RemarksOfImportPointsAndRig_AllHaveATranslation', () => {
  const english = Object.keys(portugueseRemarks);
  const remarks = ['core/import', 'core/pipeline', 'core/parametrize']
    .flatMap(sourcesIn)
    .flatMap((code) => [...code.matchAll(/(?:\bwarn|(?:warnings|file|stance|points|rig)\.(?:push_back|emplace_back))\(/g)].map((match) => insideBrackets(code, match.index + match[0].length)))
    // Which of two texts is said is not known here.
    .map((argument) => literalsOf(argument.replace(/\([^()]*\?[^()]*\)/g, '')))
    .filter((literals) => literals.some((text) => text.includes(' ')));
  expect(remarks.length).toBeGreaterThan(35);
  const has = (literals: string[]): boolean =>
    english.some((sentence) => literals.reduce((from, text) => (from < 0 || !sentence.includes(text, from) ? -1 : sentence.indexOf(text, from) + text.length), 0) >= 0);
  expect(remarks.filter((literals) => !has(literals))).toEqual([]);
});

test('Sentences_Translation_FillsInNothingThatTheServerDoesNotSay', () => {
  const names = (text: string): string[] => text.match(/\{\w+\}/g) ?? [];
  for (const [english, text] of Object.entries({ ...portugueseRemarks, ...portugueseDetails })) {
    expect(names(english), english).toEqual(expect.arrayContaining(names(text)));
    expect(new Set(names(english)).size, english).toBe(names(english).length);
    expect(text, english).not.toMatch(/\bthe\b|[.]$| {2}/);
  }
});

const translate = sentenceTranslator({ ...portugueseRemarks, ...portugueseDetails });

test.each([
  ['the axes of the head are uncertain; it keeps the axes of its file', 'os eixos da cabeça são incertos; ela fica com os do seu arquivo'],
  ['image 3 is neither PNG nor JPEG nor WebP; it is omitted', 'a imagem 3 não é PNG, nem JPEG, nem WebP; ela ficou de fora'],
  ['22 times: image 0 has more than 9 bytes; it is omitted; likewise 1, 2, 3, 4, ...', '22 vezes: a imagem 0 tem mais de 9 bytes; ela ficou de fora; também 1, 2, 3, 4, ...'],
  ["mesh 0 'Hair' is in 2 nodes; only the first is kept", "a malha 0 'Hair' está em 2 nós; só o primeiro foi mantido"],
  ['the head stands along +Z and faces -Y in its file; it is turned upright', 'a cabeça fica de pé ao longo de +Z e olha para -Y no seu arquivo; ela foi endireitada'],
  ['the right eye has no pupil: 3.6 is not marked; FAP 30 does nothing', 'o olho direito não tem pupila: 3.6 não está marcado; o FAP 30 não faz nada'],
  [
    'MW0 cannot be measured: 8.3 and 8.4 are not marked; without it these do nothing: FAPs of mouth, jaw and tongue, sideways (6, 7, 15, 43, 45, 53, 54)',
    'MW0 não pode ser medida: 8.3 e 8.4 não estão marcados; sem ela não fazem nada: FAPs da boca, mandíbula e língua, para os lados (6, 7, 15, 43, 45, 53, 54)',
  ],
  ['The model is 2 tall, which fits no unit: metres are assumed; this is not certain', 'O modelo tem 2 de altura, o que não serve a nenhuma unidade: supõem-se metros; isto não é certo'],
  ['The marked eyes are 0.064000 apart: 64 mm if the unit is m; this is not certain', 'Entre os olhos marcados há 0.064000: 64 mm se a unidade é m; isto não é certo'],
  ['line 7: more values than flags: the last are dropped (3 times)', 'linha 7: mais valores que sinalizadores: os últimos não contam (3 vezes)'],
  ["there is no model $& 'a'", "não há cabeça $& 'a'"],
])('Sentences_%s_InPortuguese', (english, portuguese) => expect(translate(english)).toBe(portuguese));

test('Sentences_TextOfWhichTheTableLacksAPart_HasNoTranslation', () => {
  expect(translate('Something else')).toBeNull();
  expect(translate('line 3: something else')).toBeNull();
  expect(translate('line of something else')).toBeNull();
  expect(translate('image 3 is something else; it is omitted')).toBeNull();
});

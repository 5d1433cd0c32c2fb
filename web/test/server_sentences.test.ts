import { readdirSync, readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { formerSentences, portugueseSentence as translate, portugueseTables } from '../src/words/portuguese_sentences.ts';

const root = new URL('../../', import.meta.url);

interface Source {
  file: string;
  code: string;
}
const sourcesIn = (folder: string): Source[] =>
  (readdirSync(new URL(folder, root), { recursive: true, encoding: 'utf8' }) as string[])
    .filter((name) => /\.(cpp|h)$/.test(name) && !name.includes('generated'))
    .map((name) => `${folder}/${name}`)
    .map((file) => ({ file, code: readFileSync(new URL(file, root), 'utf8').replace(/^\s*(\/\/|#include).*$/gm, '') }));

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

/** The literals of each file; a name of C++ (`upper_teeth`) is said with blanks. */
const files = ['core', 'server', 'protocol/cpp']
  .flatMap(sourcesIn)
  .map(({ code }) => new Set(literalsOf(code).flatMap((text) => (/^[a-z]+_[a-z]+$/.test(text) ? [text, text.replace('_', ' ')] : [text]))));

test.each(Object.entries(portugueseTables))('Sentences_Every%s_IsOneThatTheServerSays', (_, table) => {
  const said = (english: string): boolean => files.some((literals) => piecesOf(english).every((piece) => isMadeOf(piece, literals)));
  expect(Object.keys(table).filter((english) => !said(english))).toEqual([]);
});

test('Sentences_Tables_HaveNoSentenceTwice', () => {
  const all = Object.values(portugueseTables).flatMap(Object.keys).map((english) => english.replace(/\{\w+\}/g, (name) => (/fault|remark|words/.test(name) ? name : '{}')));
  expect(all.filter((english, index) => all.indexOf(english) !== index)).toEqual([]);
});

/** The parts of code between separators that are in no bracket or literal; it ends with the bracket that closes more than it opens. */
function partsBetween(code: string, separator: RegExp, whole = /^(?!)/): string[] {
  const parts: string[] = [];
  let depth = 0;
  let begin = 0;
  let at = 0;
  while (at < code.length) {
    const rest = code.slice(at, at + 2000);
    const length = (/^(?:"(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)')/.exec(rest) ?? whole.exec(rest))?.[0].length ?? 1;
    if (length === 1 && '({['.includes(rest[0]!)) depth += 1;
    else if (length === 1 && ')}]'.includes(rest[0]!)) depth -= 1;
    if (depth < 0) break;
    if (depth === 0 && length === 1 && separator.test(rest)) {
      parts.push(code.slice(begin, at));
      begin = at + 1;
    }
    at += length;
  }
  return [...parts, code.slice(begin, at)];
}

const argumentsFrom = (code: string, from: number): string[] => partsBetween(code.slice(from, from + 5000), /^,/);

/** Calls that make a fault: `fail(...)`, `Error{...}`, `refuse(...)`, `make_problem(...)` and their like. */
const faultCall = /\b(?:\w*[fF]ail\w*|\w*[eE]rror\w*|\w*[rR]efus\w*|\w*[fF]ault\w*|Error \w+|malformed|make_problem|too_many|unauthorized|at_line|full|reached)[({]|\{(?=ErrorCode::)/g;

/** Calls that remark on something: warnings of a file and of a rig, reasons for unit and axes, doubts about a proposed point. */
const remarkCall = /(?:\bwarn|(?:\bwarnings_?|\bfile|\bstance|\bpoints|\brig)\.(?:push_back|emplace_back)|\bsettle)\(|\bRimVertex\{/g;

/** A text of C++ in pieces: literals, and the code of what is filled in. */
type Piece = { text: string } | { value: string };

/** What an expression of C++ says: its alternatives. */
function alternativesOf(expression: string): Piece[][] {
  const inside = /^(?:std::string)?\((.*)\)$/s.exec(expression.trim())?.[1];
  if (inside !== undefined && partsBetween(inside, /^,/).join(',').length === inside.length) return inside === '' ? [[{ text: '' }]] : alternativesOf(inside);
  const branches = partsBetween(expression, /^[?:]/, /^::/).slice(1);
  if (branches.length > 1) return branches.flatMap(alternativesOf);
  const summands = partsBetween(expression, /^\+/);
  if (summands.length > 1)
    return summands.map(alternativesOf).reduce((all, next) => all.flatMap((before) => next.map((after) => [...before, ...after])));
  const literals = literalsOf(expression);
  return [[literals.length === 1 && /^\s*"[^]*"\s*$/.test(expression) ? { text: literals[0]! } : { value: expression.trim() }]];
}

/** The arguments of a call; pieces of one text that are passed one by one (`"vertex ", v, " moves"`) are one. */
const textsOf = (code: string, from: number): string[] =>
  argumentsFrom(code, from).reduce<string[]>((texts, next) => {
    const goesOn = / "\s*$/.test(texts.at(-1) ?? '') || /^\s*"[ ,]/.test(next);
    return goesOn && texts.length > 0 ? [...texts.slice(0, -1), `${texts.at(-1)!} + ${next}`] : [...texts, next];
  }, []);

/** Words that C++ fills in, by its expression; other values are numbers, names and sentences of the tables. */
const filledIn: Readonly<Record<string, readonly string[]>> = {
  'core/import/obj_reader.cpp: what': ['vertex', 'vertices'],
  'core/import/stl_reader.cpp: what': ['vertices'],
  'core/propose/propose.cpp: next_of_quick_set(known)': [''],
  'core/propose/propose.cpp: next_of_quick_set(marked)': [''],
  'core/propose/propose.cpp: why_none_by_shape': ['only 3 are seen'],
  'core/speech/xml_tag.cpp: what': ['the tag <x>', '<x>'],
  'protocol/cpp/performance_read.cpp: what': ['viseme'],
  'server/api/api.cpp: known': ['this route has none'],
  'server/api/authorization.cpp: in_words(rights)': ['the stream x'],
  'server/voice/speech_maker.cpp: reason': [''],
  'server/api/models.cpp: what': ['one of m, dm, cm, mm and in, or null'],
};

/** Texts that no user of the studio reads as they are, by their file and words. */
const unread: readonly (readonly [text: RegExp, why: string])[] = [
  [/^core\/(\w+\/generate|codegen)\/|^server\/api\/codegen\//, 'a program of the build says it'],
  [/^core\/parametrize\/parametrize\.cpp: the (left eye .* FAP 30|right eye .* FAP 29) does nothing$/, 'FAP 29 is of the left eye, FAP 30 of the right'],
  [/^server\/jobs\/(landlock|system_call_filter)\.cpp/, "the server's system lacks what isolates jobs: its administrator reads it"],
  [/^server\/api\/api\.cpp: (a body|an upload)$/, 'names a file in the log'],
  [/^core\/import\/obj_reader\.cpp: texture coordinates$/, 'a part of a sentence that the table has with each of its words'],
  [/^server\/recordings\/recording_writer\.cpp: a recording cannot be (written|made durable)$/, 'the reason of the system follows, with which the table has it'],
  [/^server\/api\/token_routes\.cpp: it must be \{\}$/, 'the studio asks only for scopes that there are'],
];

/** Whether the tables translate a text, with a number or another sentence for each value, and leave none of its words as they were. */
function isTranslated(file: string, pieces: readonly Piece[]): boolean {
  const fills = (before: readonly string[], piece: Piece): string[] => {
    const values = 'text' in piece ? [piece.text] : (filledIn[`${file}: ${piece.value}`] ?? ['7', 'is missing']);
    return before.flatMap((text) => values.map((value) => text + value));
  };
  // A morph target is called so in Portuguese.
  const words = pieces.flatMap((piece) => ('text' in piece && /\p{L}{2} \p{L}{2}/u.test(piece.text.replace(/morph targets?/, '')) ? [piece.text.trim()] : []));
  return pieces.reduce(fills, ['']).some((text) => {
    const portuguese = translate(text);
    return portuguese !== null && !words.some((one) => portuguese.includes(one));
  });
}

const shownWithoutValues = (pieces: readonly Piece[]): string => pieces.map((piece) => ('text' in piece ? piece.text : '{}')).join('');

/** A text with its file. */
interface Said {
  text: string;
  isTranslated: boolean;
}

/** The texts of two words or more in calls of C++. */
const saidIn = (folders: readonly string[], calls: RegExp): Said[] =>
  folders.flatMap(sourcesIn).flatMap(({ file, code }) =>
    [...code.matchAll(calls)]
      .flatMap((call) => textsOf(code, call.index + call[0].length))
      .flatMap(alternativesOf)
      .map((pieces) => ({ pieces, words: shownWithoutValues(pieces) }))
      .filter(({ words }) => /\p{L} \p{L}/u.test(words) && !words.startsWith('/'))
      .map(({ pieces, words }) => ({ text: `${file}: ${words}`, isTranslated: isTranslated(file, pieces) })),
  );

const untranslated = (texts: readonly Said[]): string[] =>
  texts.filter((one) => !one.isTranslated && !unread.some(([text]) => text.test(one.text))).map(({ text }) => text);

const folders = ['core', 'protocol/cpp', 'server/api', 'server/http', 'server/jobs', 'server/recordings', 'server/settings', 'server/streams', 'server/voice'];

test('Sentences_Remarks_AllHaveATranslation', () => {
  const remarks = saidIn(folders, remarkCall);
  expect(remarks.length).toBeGreaterThan(50);
  expect(untranslated(remarks)).toEqual([]);
});

test('Sentences_FaultsThatAUserCanMeet_AllHaveATranslation', () => {
  const faults = saidIn(folders, faultCall);
  expect(faults.length).toBeGreaterThan(600);
  expect(untranslated(faults)).toEqual([]);
});

test('Sentences_EveryException_IsSaid', () => {
  const texts = saidIn(folders, faultCall).concat(saidIn(folders, remarkCall));
  expect(unread.filter(([one]) => !texts.some(({ text, isTranslated: has }) => !has && one.test(text)))).toEqual([]);
});

test('Sentences_Translation_FillsInNothingThatTheServerDoesNotSay', () => {
  const names = (text: string): string[] => text.match(/\{\w+\}/g) ?? [];
  for (const [english, text] of Object.values(portugueseTables).flatMap(Object.entries<string>)) {
    expect(names(english), english).toEqual(expect.arrayContaining(names(text)));
    expect(new Set(names(english)).size, english).toBe(names(english).length);
    expect(text, english).not.toMatch(/\bthe\b|[.]$| {2}/);
  }
});

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
  ['The marked eyes are 0.064 apart: 64 mm if the unit is m; this is not certain', 'Entre os olhos marcados há 0,064: 64 mm se a unidade é m; isto não é certo'],
  ['line 7: more values than flags: the last are dropped (3 times)', 'linha 7: mais valores que sinalizadores: os últimos não contam (3 vezes)'],
  ["there is no model $& 'a'", "não há cabeça $& 'a'"],
  ['f refers to texture coordinate 12, but there are 3', 'f cita a coordenada de textura 12, mas há 3'],
  ['must be a whole number, not a string', 'deve ser um número inteiro, não um texto'],
  ['must be between 0.5 and 2', 'deve ficar entre 0.5 e 2'],
  ['must be between 0 and 255, not -3', 'deve ficar entre 0 e 255, não -3'],
  ['must have 3 to 5 elements, not 7', 'deve ter de 3 a 5 elementos, não 7'],
  [
    'the body cannot be read: is not valid JSON (byte 12, in /points/2.1)',
    'o corpo não pode ser lido: não é JSON válido (byte 12, em /points/2.1)',
  ],
  ['the recording is damaged: byte 12: the checksum of the chunk is wrong', 'a gravação está danificada: byte 12: a soma de verificação do bloco está errada'],
  ['the intensity of <emotion> must be 0 to 1 (byte 3)', 'a intensidade de <emotion> deve ser de 0 a 1 (byte 3)'],
  ['the voice: failed with exit code 1: there is no voice for xx', 'a voz: falhou com o código de saída 1: não há voz para xx'],
  ['the voice: failed with exit code 1: Illegal instruction', 'a voz: falhou com o código de saída 1: Illegal instruction'],
  ['the model has no upper teeth', 'o modelo não tem dentes superiores'],
  [
    'the surface is too coarse here to distinguish the upper lip from the lower lip',
    'aqui a superfície é grosseira demais para distinguir entre o lábio superior e o lábio inferior',
  ],
  [
    'feature point 2.1 moves by more than 100 MNS0: check that both meshes have the same unit and the same vertex order',
    'o ponto característico 2.1 se move mais de 100 MNS0: veja se as duas malhas têm a mesma unidade e os vértices na mesma ordem',
  ],
  [
    "the token has reached its limit of 3 models, of which it has used 3: delete models of this token, or ask the server's administrator for more",
    'o token atingiu o seu limite de 3 cabeças, dos quais usou 3: apague cabeças deste token, ou peça mais a quem administra o servidor',
  ],
])('Sentences_%s_InPortuguese', (english, portuguese) => expect(translate(english)).toBe(portuguese));

test.each([
  ["the zip has no model but 'a.fbx': export the head as GLB", "o zip não tem modelo, mas 'a.fbx': exporte a cabeça como GLB"],
  ["the zip has no model but 'a.zip': send the model that is in it", "o zip não tem modelo, mas 'a.zip': envie o modelo que há nele"],
  ["refers to 'a.bin', which is another file; send a GLB, or a zip with all files", "cita 'a.bin', que é outro arquivo; envie um GLB, ou um zip com todos os arquivos"],
])('Sentences_OfAnEarlierVersion_%s_InPortuguese', (english, portuguese) => expect(translate(english)).toBe(portuguese));

test('Sentences_OfEarlierVersions_AreSaidNoLonger', () => {
  const ends = Object.keys(formerSentences).map((english) => piecesOf(english).at(-1)!);
  expect(ends.filter((end) => files.some((literals) => [...literals].some((text) => text.includes(end))))).toEqual([]);
});

test('Sentences_TextOfWhichTheTableLacksAPart_HasNoTranslation', () => {
  expect(translate('Something else')).toBeNull();
  expect(translate('line 3: something else')).toBeNull();
  expect(translate('line of something else')).toBeNull();
  expect(translate('something: something else')).toBeNull();
  expect(translate('must be something, not something else')).toBeNull();
  expect(translate('image 3 is something else; it is omitted')).toBeNull();
});

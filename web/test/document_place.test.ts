import { describe, expect, test } from 'vitest';
import { excerptAt } from '../src/ui/documents/document_place.ts';

const document = `{"format": "semblante.performance", "version": 1,
 "note": "a } and a , and \\"/cues/1\\" in words",
 "cues": [
  {"time": 0, "duration": 10, "viseme": "o"},
  {"time": 5,
   "viseme": ["i", "q"]}
 ]}`;

const marked = (text: string, where: string): [number, string] | null => {
  const line = excerptAt(text, where).find((entry) => entry.marked);
  return line ? [line.number, line.text] : null;
};

describe('place in a document', () => {
  test('Pointer_ToValue_MarksItsLine', () => {
    expect(marked(document, '/version')?.[0]).toBe(1);
    expect(marked(document, '/cues/0/viseme')?.[0]).toBe(4);
    expect(marked(document, '/cues/1/viseme/1')).toEqual([6, '   "viseme": ["i", "q"]}']);
  });

  test('Pointer_ToMissingMember_MarksWhatItIsMissingFrom', () => {
    expect(marked(document, '/cues/1/duration')?.[0]).toBe(5);
    expect(marked(document, '/cues/7')?.[0]).toBe(3);
  });

  test('Pointer_WithEscapes_IsUnescaped', () =>
    expect(marked('{"a": 1,\n"x/y~z": {\n"q": 2}}', '/x~1y~0z/q')?.[0]).toBe(3));

  test('Line_OfFapFile_MarksIt', () => {
    const file = '# made by hand\r\n2.1 a 25 1\r\n0 1 x 1\r\n';
    expect(marked(file, 'line 3, word 3')).toEqual([3, '0 1 x 1']);
    expect(marked(file, 'line 9')).toBeNull();
  });

  test('LongLine_IsShortenedAroundThePlace', () => {
    const cues = Array.from({ length: 400 }, (_, i) => `{"time": ${i}}`).join(',');
    const [number, text] = marked(`{"cues":[${cues}]}`, '/cues/250/time')!;
    expect(number).toBe(1);
    expect(text).toContain('250');
    expect(text.length).toBeLessThan(80);
  });

  test('TextThatIsNoJson_OrNamesNoPlace_HasNoExcerptOrAHarmlessOne', () => {
    expect(excerptAt(document, undefined)).toEqual([]);
    expect(excerptAt(document, '?from')).toEqual([]);
    expect(excerptAt('', '/cues')).toEqual([]);
    for (let size = 0; size < document.length; size += 1)
      for (const line of excerptAt(document.slice(0, size), '/cues/1/viseme/1'))
        expect(line.number).toBeGreaterThan(0);
  });

  test('DeepNesting_IsWalkedWithoutRecursion', () => {
    const deep = `{"a": ${'['.repeat(200_000)}${']'.repeat(200_000)}, "b": 1}`;
    expect(marked(deep, '/b')?.[1]).toContain('"b": 1');
  });
});

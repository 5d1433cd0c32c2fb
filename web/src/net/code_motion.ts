import type { JsonFrame } from '@protocol/json_codec.ts';
import { cHeadProgram, faps, type CodeLanguage, type CodeTarget } from './code_examples.ts';
import { recordingEndings } from './recording_endings.ts';
import type { RecordingFormat } from './types.ts';

/** How long the clip of a face is, and how long it comes and goes, ms. */
const clipLength = 2000;
const ramp = 500;

/** A request whose answer a program keeps in a file. */
interface FileRequest {
  url: string;
  /** Posted as JSON; null: the file is fetched. */
  body: string | null;
  file: string;
}

/** A performance document in which the face of a frame comes and goes; ASCII without quotes for a shell to see. */
function performanceOf({ viseme, expression, ...rest }: JsonFrame): string {
  const cue = (target: object): object => ({ time: 0, duration: clipLength, attack: ramp, release: ramp, ...target });
  const expressionCue = (number: number, intensity: number): object[] => (number === 0 || intensity === 0 ? [] : [cue({ expression: number, value: intensity / 63 })]);
  const cues = [
    ...(viseme.select1 === 0 ? [] : [cue({ viseme: viseme.select1 })]),
    ...expressionCue(expression.select1, expression.intensity1),
    ...expressionCue(expression.select2, expression.intensity2),
    ...faps({ viseme, expression, ...rest }).map(([fap, value]) => cue({ fap, value })),
  ];
  return JSON.stringify({ format: 'semblante.performance', version: 1, duration: clipLength, cues });
}

/** A whole program that has the server animate the head with a face that comes and goes; in C, the vertices of each moment. */
export function clipCode(language: CodeLanguage, frame: JsonFrame, target: CodeTarget): string {
  const document = performanceOf(frame);
  const url = `${target.server}/v1/models/${encodeURIComponent(target.model)}/clip`;
  // A string of JSON is one of C, as there is nothing in it but ASCII.
  if (language === 'C') return motionInC(target, `  const char* document = ${JSON.stringify(document)};\n  size_t size = strlen(document);\n`, []);
  return programs[language]({ url, body: document, file: 'clip.glb' }, target);
}

/** A whole program that fetches a recording in a format; in C, the vertices of each of its moments. */
export function recordingCode(language: CodeLanguage, recording: string, format: RecordingFormat, target: CodeTarget): string {
  const at = (wanted: RecordingFormat): string => {
    const model = wanted === 'glb' ? `&model=${encodeURIComponent(target.model)}` : '';
    return `${target.server}/v1/recordings/${encodeURIComponent(recording)}/content?format=${wanted}${model}`;
  };
  if (language === 'C') {
    const read = '  size_t size;\n  const char* document = read_file("recording.json", &size);\n';
    return motionInC(target, read, [`'${at('performance')}' -o recording.json`]);
  }
  return programs[language]({ url: at(format), body: null, file: `recording${recordingEndings[format]}` }, target);
}

const programs: Record<Exclude<CodeLanguage, 'C'>, (request: FileRequest, target: CodeTarget) => string> = {
  curl: ({ url, body, file }, { asksForTokens }) =>
    [
      `curl --fail-with-body '${url}'`,
      ...(asksForTokens ? ['  -H "Authorization: Bearer $SEMBLANTE_TOKEN"'] : []),
      ...(body === null ? [] : [`  -H 'Content-Type: application/json'`, `  -d '${body}'`]),
      `  -o ${file}`,
    ].join(' \\\n'),
  JavaScript: ({ url, body, file }, { asksForTokens }) => {
    const headers = [...(body === null ? [] : [`'Content-Type': 'application/json'`]), ...(asksForTokens ? ['Authorization: `Bearer ${process.env.SEMBLANTE_TOKEN}`'] : [])];
    const options = [
      ...(body === null ? [] : [`  method: 'POST',`]),
      ...(headers.length === 0 ? [] : ['  headers: {', ...headers.map((header) => `    ${header},`), '  },']),
      ...(body === null ? [] : [`  body: JSON.stringify(${body}),`]),
    ];
    const second = options.length === 0 ? '' : `, {\n${options.join('\n')}\n}`;
    return `import { writeFile } from 'node:fs/promises';

const response = await fetch('${url}'${second});
if (!response.ok) throw new Error(await response.text());
await writeFile('${file}', new Uint8Array(await response.arrayBuffer()));
`;
  },
  Python: ({ url, body, file }, { asksForTokens }) => {
    const headers = [...(body === null ? [] : ['"Content-Type": "application/json"']), ...(asksForTokens ? ['"Authorization": f"Bearer {os.environ[\'SEMBLANTE_TOKEN\']}"'] : [])];
    const data = body === null ? '' : `\n    data=b'${body}',`;
    return `${asksForTokens ? 'import os\n' : ''}import shutil
import urllib.request

request = urllib.request.Request(
    "${url}",${data}
    headers={${headers.join(', ')}},
)
with urllib.request.urlopen(request) as response, open("${file}", "wb") as file:
    shutil.copyfileobj(response, file)
`;
  },
};

/** `read`: declares `document` and `size`; `fetched`: further files that curl fetches first. */
const motionInC = (target: CodeTarget, read: string, fetched: readonly string[]): string =>
  cHeadProgram(target, {
    fetched,
    declarations: `${read}  semblante_performance* performance = NULL;\n  double ms;\n`,
    body: `  if (semblante_performance_create(document, size, &performance, &error) != SEMBLANTE_OK) {
    fprintf(stderr, "%s: %s\\n", error.where, error.message);
    return 1;
  }
  for (ms = 0; ms <= semblante_performance_duration(performance); ms += 40) {
    semblante_performance_frame_at(performance, ms, ms, &frame);
    semblante_head_set_frame(head, &frame);
    print_positions(head);
  }
  semblante_performance_destroy(performance);
`,
  });

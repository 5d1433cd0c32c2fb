import type { JsonFrame } from '@protocol/json_codec.ts';

export const codeLanguages = ['curl', 'JavaScript', 'Python', 'C'] as const;
export type CodeLanguage = (typeof codeLanguages)[number];

export interface CodeTarget {
  /** Address of the server, without a slash at its end. */
  server: string;
  /** Ids of the stream to send into and of the model to deform. */
  stream: string;
  model: string;
  asksForTokens: boolean;
}

/** Whether the example of a language sends the frame into a stream; the others compute the vertices of a head. */
export const sendsIntoStream = (language: CodeLanguage): boolean => language === 'curl' || language === 'JavaScript';

/** A whole program that shows one frame, for a file or a shell. FAPs in FAP units. */
export function codeFor(language: CodeLanguage, frame: JsonFrame, target: CodeTarget): string {
  return programs[language](frame, target);
}

const programs: Record<CodeLanguage, (frame: JsonFrame, target: CodeTarget) => string> = {
  curl: curlProgram,
  JavaScript: javascriptProgram,
  Python: pythonProgram,
  C: cProgram,
};

const framesUrl = ({ server, stream }: CodeTarget): string => `${server}/v1/streams/${encodeURIComponent(stream)}/frames`;
const modelUrl = ({ server, model }: CodeTarget): string => `${server}/v1/models/${encodeURIComponent(model)}`;

/** A FAP value without the noise of its binary form. */
const short = (value: number): number => Number(value.toPrecision(7));

/** The FAPs of a frame with their values. */
export const faps = (frame: JsonFrame): [number, number][] =>
  Object.entries(frame.faps).map(([fap, value]) => [Number(fap), short(value)]);

/** The request's body; no part of it has a quote or backslash for a shell to see. */
function bodyOf({ viseme, expression, ...rest }: JsonFrame): string {
  return JSON.stringify({ frames: [{ viseme, expression, faps: Object.fromEntries(faps({ viseme, expression, ...rest })) }] });
}

function curlProgram(frame: JsonFrame, target: CodeTarget): string {
  return [
    `curl -X POST '${framesUrl(target)}'`,
    `  -H 'Content-Type: application/json'`,
    ...(target.asksForTokens ? ['  -H "Authorization: Bearer $SEMBLANTE_TOKEN"'] : []),
    `  -d '${bodyOf(frame)}'`,
  ].join(' \\\n');
}

function javascriptProgram(frame: JsonFrame, target: CodeTarget): string {
  const token = target.asksForTokens ? '\n    Authorization: `Bearer ${process.env.SEMBLANTE_TOKEN}`,' : '';
  return `const response = await fetch('${framesUrl(target)}', {
  method: 'POST',
  headers: {
    'Content-Type': 'application/json',${token}
  },
  body: JSON.stringify(${bodyOf(frame)}),
});
if (!response.ok) throw new Error(await response.text());
console.log(await response.json());
`;
}

/** The token is read from the environment by the package itself. */
function pythonProgram(frame: JsonFrame, { server, model }: CodeTarget): string {
  const { viseme, expression } = frame;
  const values = faps(frame).map(([fap, value]) => `${fap}: ${value}`);
  return `import semblante

head = semblante.fetch_head("${server}", "${model}")
frame = semblante.frame(
    {${values.join(', ')}},  # FAP: value
    viseme=(${viseme.select1}, ${viseme.select2}, ${viseme.blend} / 63),
    expression=[(${expression.select1}, ${expression.intensity1} / 63), (${expression.select2}, ${expression.intensity2} / 63)],
)
head.set_frame(frame)
for x, y, z in head.positions().tolist():
    print(x, y, z)
`;
}

function cProgram(frame: JsonFrame, target: CodeTarget): string {
  const { viseme, expression } = frame;
  return cHeadProgram(target, {
    body: `  frame.viseme1 = ${viseme.select1};
  frame.viseme2 = ${viseme.select2};
  frame.viseme_blend = ${viseme.blend};
  frame.expression1 = ${expression.select1};
  frame.intensity1 = ${expression.intensity1};
  frame.expression2 = ${expression.select2};
  frame.intensity2 = ${expression.intensity2};
${faps(frame)
  .map(([fap, value]) => `  frame.fap[${fap}] = ${value};\n`)
  .join('')}  semblante_head_set_frame(head, &frame);
  print_positions(head);
`,
  });
}

interface CParts {
  /** After the head has been made. */
  body: string;
  declarations?: string;
  /** Further arguments of curl: what the program reads besides the head. */
  fetched?: readonly string[];
}

/** A C program that reads a head; its body sets a \`frame\` and prints the vertices. */
export function cHeadProgram(target: CodeTarget, { body, declarations = '', fetched = [] }: CParts): string {
  const url = modelUrl(target);
  const token = target.asksForTokens ? ' -H "Authorization: Bearer $SEMBLANTE_TOKEN"' : '';
  return `/* Save as pose.c, then:
 *   curl${token} ${[`-O '${url}/mesh.drc'`, `-O '${url}/weights'`, `-O '${url}/rig.json'`, ...fetched].join(' ')}
 *   cc pose.c $(pkg-config --cflags --libs semblante) -o pose && ./pose */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <semblante/semblante.h>

static void* read_file(const char* name, size_t* size) {
  FILE* file = fopen(name, "rb");
  void* bytes;
  long length;
  if (file == NULL || fseek(file, 0, SEEK_END) != 0 || (length = ftell(file)) <= 0) {
    fprintf(stderr, "%s cannot be read\\n", name);
    exit(1);
  }
  rewind(file);
  bytes = malloc((size_t)length);
  *size = bytes == NULL ? 0 : fread(bytes, 1, (size_t)length, file);
  fclose(file);
  return bytes;
}

static void print_positions(const semblante_head* head) {
  uint32_t i, count = semblante_head_vertex_count(head);
  float* positions = malloc((size_t)count * 3 * sizeof(float));
  if (positions == NULL || semblante_head_positions(head, positions, (size_t)count * 3) != SEMBLANTE_OK) exit(1);
  for (i = 0; i < count; ++i) printf("%g %g %g\\n", positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
  free(positions);
}

int main(void) {
  semblante_package package = {0};
  semblante_frame frame = {0};
  semblante_error error;
  semblante_head* head = NULL;
${declarations}  package.size = sizeof(package);
  package.mesh_drc = read_file("mesh.drc", &package.mesh_drc_size);
  package.weights = read_file("weights", &package.weights_size);
  package.rig_json = read_file("rig.json", &package.rig_json_size);
  if (semblante_head_create(&package, NULL, &head, &error) != SEMBLANTE_OK) {
    fprintf(stderr, "%s: %s\\n", error.where, error.message);
    return 1;
  }

${body}  semblante_head_destroy(head);
  return 0;
}
`;
}

import type { Sentences } from './server_sentences.ts';

/** Faults of OBJ, PLY, STL and zip files, of the files of points and displacements, and of a model's points, in Brazilian Portuguese by their English form. */
export const portugueseMeshFaults: Sentences = {
  // OBJ.
  '{statement} has {count} numbers, but needs {needed}': '{statement} tem {count} números, mas precisa de {needed}',
  '{statement} has {token} in place of a number': '{statement} tem {token} no lugar de um número',
  '{statement} has {token}, which is not a finite number': '{statement} tem {token}, que não é um número finito',
  'f refers to vertex {place}, but there are {count}': 'f cita o vértice {place}, mas há {count}',
  'f refers to texture coordinate {place}, but there are {count}': 'f cita a coordenada de textura {place}, mas há {count}',
  'f refers to normal {place}, but there are {count}': 'f cita a normal {place}, mas há {count}',
  'more than {limit} vertices': 'mais de {limit} vértices',
  'more than {limit} texture coordinates': 'mais de {limit} coordenadas de textura',
  'more than {limit} normals': 'mais de {limit} normais',

  // PLY.
  "{line_text} must be 'element <name> <count>'": "{line_text} deve ser 'element <nome> <quantidade>'",
  'more than {limit} kinds of elements': 'mais de {limit} tipos de elementos',
  "{line_text} must be 'property [list <type>] <type> <name>' of an element": "{line_text} deve ser 'property [list <tipo>] <tipo> <nome>' de um elemento",
  'more than {limit} properties': 'mais de {limit} propriedades',
  "the header has no 'format'": "o cabeçalho não tem 'format'",
  '{line_text} is not a line of a PLY header': '{line_text} não é uma linha de cabeçalho PLY',
  "the header ends without 'end_header'": "o cabeçalho acaba sem 'end_header'",
  'the header declares {elements} elements {name}, but only {bytes} bytes are left': 'o cabeçalho declara {elements} elementos {name}, mas só restam {bytes} bytes',
  'property {name} is not a finite number': 'a propriedade {name} não é um número finito',
  "the header has element 'vertex' twice": "o cabeçalho tem o elemento 'vertex' duas vezes",
  "the header has no element 'vertex'": "o cabeçalho não tem o elemento 'vertex'",
  "element 'vertex' has no property {name}": "o elemento 'vertex' não tem a propriedade {name}",
  "element {name} has no list 'vertex_indices'": "o elemento {name} não tem a lista 'vertex_indices'",
  "element 'tristrips'": "elemento 'tristrips'",
  'a face has a vertex index that is negative, not an integer or too large': 'uma face tem um índice de vértice que é negativo, não é inteiro ou é grande demais',
  'a triangle strip has an item that is neither -1 nor the index of a vertex': 'uma tira de triângulos tem um item que não é -1 nem o índice de um vértice',
  'list {name} has a number of items that is invalid or exceeds the data': 'a lista {name} tem um número de itens inválido ou maior que os dados',
  '{token} is not a number': '{token} não é um número',

  // STL.
  'a facet has more than 3 corners': 'uma faceta tem mais de 3 cantos',
  'a facet has fewer than 3 corners': 'uma faceta tem menos de 3 cantos',
  'vertex has {token} in place of a number': 'vertex tem {token} no lugar de um número',
  'vertex has {token}, which is not a finite number': 'vertex tem {token}, que não é um número finito',
  '{token} is no word of an STL': '{token} não é uma palavra de STL',

  // Zip.
  'the zip has more than {limit} entries': 'o zip tem mais de {limit} arquivos',
  'the zip has no entry {name}': 'o zip não tem o arquivo {name}',
  "the zip's entry {name} cannot be opened: {message}": 'o arquivo {name} do zip não pode ser aberto: {message}',

  // Any file of a model.
  'unknown model format': 'formato de modelo desconhecido',

  // Points and displacements.
  'has neither a vertex nor a position': 'não tem vértice nem posição',
  'must have 3 rows of 3 numbers': 'deve ter 3 linhas de 3 números',
  'has no inverse': 'não tem inversa',
  'must be 0, because vertices are numbered from 0': 'deve ser 0, porque os vértices são numerados a partir de 0',
  '{name} is not a feature point of MPEG-4 (2.1 to 11.6)': '{name} não é um ponto característico do MPEG-4 (2.1 a 11.6)',
  'has no points': 'não tem pontos',
  'no feature point has a displacement': 'nenhum ponto característico tem deslocamento',

  // Scans and expressions.
  'must be a finite number of at least 0': 'deve ser um número finito de ao menos 0',
  'must be a number from 0.01 to 100': 'deve ser um número de 0,01 a 100',
  'feature point {point} moves by more than {length}0: check that both meshes have the same unit and the same vertex order':
    'o ponto característico {point} se move mais de {length}0: veja se as duas malhas têm a mesma unidade e os vértices na mesma ordem',
  'the expression moves none of the marked feature points: {reason}': 'a expressão não move nenhum dos pontos característicos marcados: {reason}',
  'omitted, because {unit} of this head is unknown: {points}': 'ficaram de fora, porque {unit} desta cabeça não é conhecida: {points}',
  'omitted, because they have no vertex: {points}': 'ficaram de fora, porque não têm vértice: {points}',
  'not marked on this head: {points}': 'não marcados nesta cabeça: {points}',
  'moves by more than 102400 units': 'move-se mais de 102400 unidades',
  'must be at most 200 bytes of printable text': 'deve ter no máximo 200 bytes de texto imprimível',
  'must be "viseme" or "expression"': 'deve ser "viseme" ou "expression"',
  'the model has no morph target of this name; it has no morph targets': 'o modelo não tem morph target com este nome; ele não tem morph targets',
  'the model has no morph target of this name; it has {names}': 'o modelo não tem morph target com este nome; ele tem {names}',
};

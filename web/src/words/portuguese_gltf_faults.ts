import type { Sentences } from './server_sentences.ts';

/** Faults of a glTF file, its buffers, Draco and meshopt data, and of any JSON, in Brazilian Portuguese by their English form. */
export const portugueseGltfFaults: Sentences = {
  // JSON of any kind.
  'must be {wanted}, not {found}': 'deve ser {wanted}, não {found}',
  'must be an object, not {found}': 'deve ser um objeto, não {found}',
  'an object': 'um objeto',
  'an array': 'uma lista',
  'a string': 'um texto',
  'a number': 'um número',
  'a whole number': 'um número inteiro',
  'true or false': 'true ou false',
  object: 'um objeto',
  array: 'uma lista',
  string: 'um texto',
  number: 'um número',
  boolean: 'true ou false',
  null: 'null',
  'must have {least} to {most} elements, not {number}': 'deve ter de {least} a {most} elementos, não {number}',
  'must have {least} elements, not {number}': 'deve ter {least} elementos, não {number}',
  'must be a whole number': 'deve ser um número inteiro',
  'must be between {least} and {most}': 'deve ficar entre {least} e {most}',
  'must be between {least} and {most}, not {found_number}': 'deve ficar entre {least} e {most}, não {found_number}',
  'must not exceed {limit} bytes': 'não deve passar de {limit} bytes',
  'refers to an empty list': 'cita uma lista vazia',
  'is not valid JSON (byte {byte}, in {place})': 'não é JSON válido (byte {byte}, em {place})',
  'is a number too large for a double': 'é um número grande demais para um double',
  'is nested deeper than {limit}': 'tem mais de {limit} níveis de aninhamento',
  'has more than {limit} values': 'tem mais de {limit} valores',
  'occurs twice': 'aparece duas vezes',

  // The GLB container and data in addresses.
  'a chunk declares {declared} bytes, only {left} are left': 'um bloco declara {declared} bytes; só restam {left}',
  'is a data: URI that is not base64': 'é um URI data: que não está em base64',
  'is a data: URI that is too large': 'é um URI data: grande demais',
  'is a data: URI with a character that is not base64': 'é um URI data: com um caractere que não é de base64',
  'refers to {name}, which is another file': 'cita {name}, que é outro arquivo',

  // Buffers and accessors.
  'has no uri, but only buffer 0 can be the binary chunk': 'não tem uri, mas só o buffer 0 pode ser o bloco binário',
  'is {size}, but the buffer has {bytes} bytes': 'é {size}, mas o buffer tem {bytes} bytes',
  'spans bytes {from} to {to} of a buffer of {bytes} bytes': 'vai do byte {from} ao {to} de um buffer de {bytes} bytes',
  'must be equal to the byteStride of its buffer view': 'deve ser igual ao byteStride da sua buffer view',
  'is {size}, but its meshopt data decodes to {bytes} bytes': 'é {size}, mas os seus dados meshopt têm, decodificados, {bytes} bytes',
  'repeats Draco data: all references together exceed {number} times the size of the file':
    'repete dados Draco: todas as citações juntas passam de {number} vezes o tamanho do arquivo',
  'is {size}, but elements have {bytes} bytes': 'é {size}, mas os elementos têm {bytes} bytes',
  'needs {needed} bytes, but its buffer view has {bytes}': 'precisa de {needed} bytes, mas a sua buffer view tem {bytes}',
  'is {size}, at most {limit} are allowed': 'é {size}; são aceitos no máximo {limit}',
  'has {bytes} bytes, at most {limit} are allowed': 'tem {bytes} bytes; são aceitos no máximo {limit}',
  'must be an unsigned type': 'deve ser um tipo sem sinal',
  'has index {index}, but the accessor has {count} elements': 'tem o índice {index}, mas o accessor tem {count} elementos',
  'is not a component type': 'não é um tipo de componente',
  'must have {count} components': 'deve ter {count} componentes',
  'is {size}, but must be {needed}': 'é {size}, mas deve ser {needed}',
  'element {number} is not a finite number': 'o elemento {number} não é um número finito',
  'must be SCALAR': 'deve ser SCALAR',
  'element {number} refers to vertex {vertex}, but there are {count} vertices': 'o elemento {number} cita o vértice {vertex}, mas há {count} vértices',

  // Scene, meshes, materials.
  'must have 3 numbers': 'deve ter 3 números',
  'must have {count} numbers': 'deve ter {count} números',
  'is too large': 'é grande demais',
  'has no attribute POSITION': 'não tem o atributo POSITION',
  'must be a glTF mode, 0 to 6': 'deve ser um modo do glTF, de 0 a 6',
  'must be a quaternion other than zero': 'deve ser um quatérnio que não seja zero',
  'is in the scene twice, but nodes must form trees': 'está duas vezes na cena, mas os nós devem formar árvores',
  'has more than {limit} joints': 'tem mais de {limit} articulações',
  'moves a vertex by more than 1e15': 'move um vértice em mais de 1e15',

  // Draco.
  'has Draco bitstream version {version}, but only 2.2 is supported': 'tem dados Draco da versão {version}, mas só a 2.2 é suportada',
  'is Draco data, but not a triangle mesh': 'são dados Draco, mas não de uma malha de triângulos',
  'uses an unsupported Draco encoding method': 'usa um método de codificação do Draco que não é suportado',
  'has Draco data that ends within its header': 'tem dados Draco que acabam dentro do cabeçalho',
  'declares {faces} faces and {points} points, more than {bytes} bytes of Draco data can contain':
    'declara {faces} faces e {points} pontos, mais do que cabe em {bytes} bytes de dados Draco',
  'declares {faces} faces and {points} points of Draco data, at most {most_faces} and {most_points} are allowed':
    'declara {faces} faces e {points} pontos de dados Draco; são aceitos no máximo {most_faces} e {most_points}',
  'has Draco data that needs more memory than is available': 'tem dados Draco que precisam de mais memória do que há',
  'has Draco data that declares an impossible size': 'tem dados Draco que declaram um tamanho impossível',
  'has Draco data that decodes to more than the limit': 'tem dados Draco que, decodificados, passam do limite',
  'has Draco data whose face {number} refers to point {point}, but there are {count}':
    'tem dados Draco em que a face {number} cita o ponto {point}, mas há {count}',
  'refers to Draco attribute {attribute}, which does not exist': 'cita o atributo {attribute} do Draco, que não existe',
  'refers to a Draco attribute of {count} components, but needs {needed}': 'cita um atributo do Draco de {count} componentes, mas precisa de {needed}',
  'refers to a Draco attribute for colours that has no bytes': 'cita um atributo do Draco de cores que não tem bytes',
  'refers to a Draco attribute of an unsupported type': 'cita um atributo do Draco de um tipo que não é suportado',
  'has Draco data with points that have no value': 'tem dados Draco com pontos sem valor',
  'has Draco data with a number that is not finite': 'tem dados Draco com um número que não é finito',

  // meshopt.
  'has {stride}, but indices have 2 or 4 bytes': 'tem {stride}, mas índices têm 2 ou 4 bytes',
  'has a count of triangle indices that is not a multiple of 3': 'tem um número de índices de triângulos que não é múltiplo de 3',
  'has a filter for indices': 'tem um filtro para índices',
  'has {stride}, but it must be a multiple of 4 up to 256': 'tem {stride}, mas ele deve ser um múltiplo de 4 até 256',
  'has {stride}, but the filter OCTAHEDRAL needs 4 or 8': 'tem {stride}, mas o filtro OCTAHEDRAL precisa de 4 ou 8',
  'has {stride}, but the filter QUATERNION needs 8': 'tem {stride}, mas o filtro QUATERNION precisa de 8',
  'must be ATTRIBUTES, TRIANGLES or INDICES': 'deve ser ATTRIBUTES, TRIANGLES ou INDICES',
  'must be NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL': 'deve ser NONE, OCTAHEDRAL, QUATERNION ou EXPONENTIAL',
  'declares {elements} elements, more than {bytes} bytes of meshopt data can contain':
    'declara {elements} elementos, mais do que cabe em {bytes} bytes de dados meshopt',
  'has meshopt data that decodes to more than {limit} bytes': 'tem dados meshopt que, decodificados, passam de {limit} bytes',
  'has meshopt data that cannot be decoded': 'tem dados meshopt que não podem ser decodificados',

  // Images.
  'is a WebP image that cannot be decoded': 'é uma imagem WebP que não pode ser decodificada',
  'is a WebP image that moves, which no texture can': 'é uma imagem WebP animada, o que uma textura não pode ser',
};

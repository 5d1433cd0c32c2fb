import type { Sentences } from './server_sentences.ts';

/** Remarks of the server on a file, its points and its rig, in Brazilian Portuguese by their English form. */
export const portugueseRemarks: Sentences = {
  // Equal remarks are said once (core/types/warning_groups.h).
  '{count} times: {remark}': '{count} vezes: {remark}',
  '{remark}; likewise {names}': '{remark}; também {names}',
  'and {count} more warnings': 'e mais {count} avisos',

  // The file.
  'the normal map of material {material} has other texture coordinates than its base colour and is omitted':
    'o mapa de normais do material {material} tem coordenadas de textura diferentes das da cor de base e ficou de fora',
  'texture {number} has no image and is omitted': 'a textura {number} não tem imagem e ficou de fora',
  'image {number} {fault}; it is omitted': 'a imagem {number} {fault}; ela ficou de fora',
  'the image {name} {fault}; it is omitted': 'a imagem {name} {fault}; ela ficou de fora',
  '{count} bytes after the last facet were not read': '{count} bytes depois da última faceta não foram lidos',
  '{name}, to which the OBJ file refers, is omitted: {fault}': '{name}, que o arquivo OBJ cita, ficou de fora: {fault}',
  'the material file {name} is too large and is omitted': 'o arquivo de materiais {name} é grande demais e ficou de fora',
  'the material file {name} was not read, so materials have default colours; send a zip of the OBJ file, its material file and images':
    'o arquivo de materiais {name} não foi lido, e os materiais têm cores padrão; envie um zip com o arquivo OBJ, o seu arquivo de materiais e as imagens',
  '{target} has a different number of vertices than its primitive and is omitted': '{target} não tem tantos vértices quanto a sua primitiva e ficou de fora',
  'the morph targets have more displacements than the limit; the last targets are omitted':
    'os morph targets têm mais deslocamentos do que o limite; os últimos ficaram de fora',
  'the file shows its morph target {target} at {weight}; the head is read without it':
    'o arquivo mostra o seu morph target {target} em {weight}; a cabeça é lida sem ele',
  '{target} has the same name {name} as an earlier target and is omitted': '{target} tem o mesmo nome {name} de um morph target anterior e ficou de fora',
  'vertex colours are omitted: green or blue is missing': 'as cores de vértices ficaram de fora: falta o verde ou o azul',
  'all vertex colours are black and are omitted: the face has those of its materials':
    'todas as cores de vértices são pretas e ficaram de fora: o rosto tem as dos seus materiais',
  'colours of faces are omitted: only those of vertices are read': 'as cores de faces ficaram de fora: só as de vértices são lidas',
  '{count} vertices have a colour that is not three numbers: they are white': '{count} vértices têm uma cor que não é de três números: são brancos',
  '{count} faces with fewer than 3 corners were omitted': '{count} faces com menos de 3 cantos ficaram de fora',
  '{count} lines are not OBJ statements and were skipped; the first is {line}':
    '{count} linhas não são instruções de OBJ e foram puladas; a primeira é {line}',
  '{count} triangles that use a vertex twice were omitted': '{count} triângulos que usam um vértice duas vezes ficaram de fora',
  'mesh {number} {name} is in no node of the scene: its vertices keep their numbers, its triangles are omitted':
    'a malha {number} {name} não está em nenhum nó da cena: os seus vértices mantêm os números, os seus triângulos ficaram de fora',
  'mesh {number} {name} is in {count} nodes; only the first is kept': 'a malha {number} {name} está em {count} nós; só o primeiro foi mantido',
  'mesh {number} {name} is in {count} nodes; only {kept} are kept': 'a malha {number} {name} está em {count} nós; só {kept} foram mantidos',
  '{primitive} has no positions and is omitted': '{primitive} não tem posições e ficou de fora',
  '{primitive} has points or lines: its vertices keep their numbers, nothing is drawn':
    '{primitive} tem pontos ou linhas: os seus vértices mantêm os números, nada é desenhado',
  '{primitive} has {count} indices, not a multiple of 3; the last are omitted': '{primitive} tem {count} índices, que não são múltiplo de 3; os últimos ficaram de fora',
  'the model is so far from the origin that its coordinates are rounded to {step}, and it is only {size} large: move it to the origin before the export':
    'o modelo está tão longe da origem que as suas coordenadas são arredondadas a {step}, e ele só tem {size} de tamanho: leve-o à origem antes de exportar',
  'the model was inside out, as one that was mirrored: its triangles faced inwards; all are turned over':
    'o modelo estava do avesso, como um que foi espelhado: os seus triângulos olhavam para dentro; todos foram virados',

  // Images that are left out.
  'has more than {limit} bytes': 'tem mais de {limit} bytes',
  'is a PNG of {size} pixels, of which nothing can be shown': 'é um PNG de {size} pixels, do qual nada pode ser mostrado',
  'is a JPEG of {size} pixels, of which nothing can be shown': 'é um JPEG de {size} pixels, do qual nada pode ser mostrado',
  'is a PNG without a whole header, of which nothing can be shown': 'é um PNG sem cabeçalho inteiro, do qual nada pode ser mostrado',
  'is a JPEG without a whole header, of which nothing can be shown': 'é um JPEG sem cabeçalho inteiro, do qual nada pode ser mostrado',
  'is an image of {size} pixels, more than {limit} along a side': 'é uma imagem de {size} pixels, mais de {limit} num dos lados',
  'is a KTX2 texture (Basis Universal), which cannot be read here; PNG, JPEG and WebP can':
    'é uma textura KTX2 (Basis Universal), que aqui não pode ser lida; PNG, JPEG e WebP podem',
  'is neither PNG nor JPEG nor WebP': 'não é PNG, nem JPEG, nem WebP',
  'is a {format} of {size}, more than {limit} pixels': 'é um {format} de {size}, mais de {limit} pixels',
  'is a {format} of {size}, with which all together have more than {limit} pixels':
    'é um {format} de {size}, com o qual todas juntas têm mais de {limit} pixels',
  'is a {format} that cannot be decoded': 'é um {format} que não pode ser decodificado',

  // How the head stands.
  'the head {stance}; it is turned upright': 'a cabeça {stance}; ela foi endireitada',
  'the head {stance}, as far as its shape shows; it is turned upright': 'a cabeça {stance}, pelo que a sua forma mostra; ela foi endireitada',
  'the feature points show that the head {stance}; it is turned upright': 'os pontos característicos mostram que a cabeça {stance}; ela foi endireitada',
  'the axes of the head are uncertain; it keeps the axes of its file': 'os eixos da cabeça são incertos; ela fica com os do seu arquivo',
  'the head is tilted by {tilt} degrees on its body; its points move along the axes of the body':
    'a cabeça está inclinada em {tilt} graus sobre o corpo; os seus pontos se movem pelos eixos do corpo',
  'stands along {up} and faces {front} in its file': 'fica de pé ao longo de {up} e olha para {front} no seu arquivo',
  'stands along {up} and faces {front} and is tilted by {tilt} degrees in its file':
    'fica de pé ao longo de {up}, olha para {front} e está inclinada em {tilt} graus no seu arquivo',
  'is tilted by {tilt} degrees in its file': 'está inclinada em {tilt} graus no seu arquivo',

  // Why this unit and these axes.
  '{reason}; this is not certain': '{reason}; isto não é certo',
  'The unit is {unit}, as set by the user': 'A unidade é {unit}, como foi definida à mão',
  'The head stands along {up} and faces {front}, as set by the user': 'A cabeça fica de pé ao longo de {up} e olha para {front}, como foi definido à mão',
  'The shape indicates {up} up and the face towards {front}, but the user set other axes':
    'A forma indica {up} para cima e o rosto para {front}, mas outros eixos foram definidos à mão',
  'The points of the left side lie on the right, seen from up and front: left and right are exchanged, or the model is a mirror image':
    'Os pontos do lado esquerdo estão à direita, vistos de cima e da frente: esquerda e direita estão trocadas, ou o modelo está espelhado',
  'The feature points stand {up} up, the face towards {front}': 'Os pontos característicos ficam com {up} para cima e o rosto para {front}',
  'The feature points stand {up} up, their pairs apart along {axis}, the face towards {front}':
    'Os pontos característicos ficam com {up} para cima, os pares separados ao longo de {axis}, o rosto para {front}',
  '{reason}, but so unclearly that it might be another way': '{reason}, mas isto é tão pouco claro que pode ser de outro modo',
  'The face is tilted by {tilt} degrees from these axes, by the symmetry of its points and the proportions of faces':
    'O rosto está inclinado em {tilt} graus em relação a estes eixos, pela simetria dos seus pontos e pelas proporções de rostos',
  "The marked eyes are {length} apart, which is no head's size in m, dm, cm, mm or in":
    'Entre os olhos marcados há {length}, o que não é o tamanho de uma cabeça em m, dm, cm, mm ou in',
  'The marked eyes are {length} apart: {millimetres} mm if the unit is {unit}': 'Entre os olhos marcados há {length}: {millimetres} mm se a unidade é {unit}',
  'glTF models stand along +Y and face +Z': 'Modelos glTF ficam de pé ao longo de +Y e olham para +Z',
  'glTF models stand along +Y and face +Z, but this one would lie on its face then':
    'Modelos glTF ficam de pé ao longo de +Y e olham para +Z, mas este ficaria deitado sobre o rosto',
  'The axes of the head are uncertain without feature points: {up} is assumed to be up, and {front} the front':
    'Sem pontos característicos os eixos da cabeça são incertos: supõe-se que {up} seja o topo, e {front}, a frente',
  'Parts named as eyes are apart along {axis}': 'Partes com nomes de olhos estão separadas ao longo de {axis}',
  'Two equal balls, assumed to be eyes, are apart along {axis}': 'Duas bolas iguais, que devem ser os olhos, estão separadas ao longo de {axis}',
  'The largest part is its own mirror image across {axis}': 'A maior parte é simétrica ao longo de {axis}',
  'The eyes are {direction} of the teeth or tongue': 'Os olhos ficam para {direction} dos dentes ou da língua',
  'The largest part ends open and flat at its {direction} end, as a neck does': 'A maior parte acaba aberta e reta em {direction}, como um pescoço',
  'Seen from {front}, with {up} up, the model is like a face': 'Visto de {front}, com {up} para cima, o modelo parece um rosto',
  'The eyes are near the {direction} side of the head': 'Os olhos ficam perto do lado {direction} da cabeça',
  'The balls are near the {direction} side of the head, away from the densest vertices: they are hardly eyes':
    'As bolas ficam perto do lado {direction} da cabeça, longe dos vértices mais densos: não devem ser olhos',
  'The vertices are densest towards {direction}, as in a face': 'Os vértices são mais densos para {direction}, como num rosto',
  "The eyes are {length} apart, which is a face's if the unit is {unit}": 'Entre os olhos há {length}, como num rosto se a unidade é {unit}',
  'The unit of glTF is the metre, and {height} m fits a head or a body': 'A unidade do glTF é o metro, e {height} m serve a uma cabeça ou a um corpo',
  "The unit of glTF is the metre, and {height} m is nearly a head's or a body's size":
    'A unidade do glTF é o metro, e {height} m é quase o tamanho de uma cabeça ou de um corpo',
  "The model is {height} tall, which is a head's, a bust's or a body's size if the unit is {unit}":
    'O modelo tem {height} de altura, o tamanho de uma cabeça, de um busto ou de um corpo se a unidade é {unit}',
  'The model is {height} tall, which fits no unit: metres are assumed': 'O modelo tem {height} de altura, o que não serve a nenhuma unidade: supõem-se metros',

  // The points.
  'the vertex numbers of {points} belong to another numbering of this model; the points were placed by their positions':
    'os números de vértice de {points} são de outra numeração deste modelo; os pontos foram marcados pelas suas posições',
  'vertex and position of {points} disagree; the vertex was taken': 'vértice e posição de {points} não combinam; vale o vértice',
  'the position of {points} is not on the surface; the nearest place on it was taken':
    'a posição de {points} não está na superfície; vale o lugar mais próximo nela',

  // What does not move.
  'no feature point is marked on the surface; nothing will move': 'nenhum ponto característico está marcado na superfície; nada vai se mover',
  'point {point} is at a vertex that no triangle uses; it moves nothing': 'o ponto {point} está num vértice que nenhum triângulo usa; ele não move nada',
  'points {first} and {second} are at the same place; that vertex follows the mean of both':
    'os pontos {first} e {second} estão no mesmo lugar; o vértice segue a média dos dois',
  "the eyes are closed: ES0 is the distance between the centres of the lids' corners, and IRISD0 {share} % of it; both can be given by hand":
    'os olhos estão fechados: ES0 é a distância entre os centros dos cantos das pálpebras, e IRISD0, {share} % dela; as duas podem ser definidas à mão',
  '2.1 is not marked; lower teeth and tongue do not follow the jaw': '2.1 não está marcado; os dentes de baixo e a língua não seguem a mandíbula',
  'no part is the left eye; FAPs 23, 25 and 27 turn nothing': 'nenhuma parte é o olho esquerdo; os FAPs 23, 25 e 27 não giram nada',
  'no part is the right eye; FAPs 24, 26 and 28 turn nothing': 'nenhuma parte é o olho direito; os FAPs 24, 26 e 28 não giram nada',
  '7.1 is not marked; the centre of head rotation is an estimate': '7.1 não está marcado; o centro de rotação da cabeça é uma estimativa',
  'the left eye {fault}; FAP 29 does nothing': 'o olho esquerdo {fault}; o FAP 29 não faz nada',
  'the right eye {fault}; FAP 30 does nothing': 'o olho direito {fault}; o FAP 30 não faz nada',
  'is no part': 'não é uma parte',
  'has no pupil: {point} is not marked': 'não tem pupila: {point} não está marcado',
  'has an iris of unknown size: IRISD is not known': 'tem uma íris de tamanho desconhecido: IRISD não é conhecida',
  'has no vertices between the middle of its pupil and the rim of its iris': 'não tem vértices entre o meio da pupila e a borda da íris',
  'there is no tongue; FAP 47 rolls nothing': 'não há língua; o FAP 47 não enrola nada',
  '{unit} cannot be measured: {fault}; without it these do nothing: {faps}': '{unit} não pode ser medida: {fault}; sem ela não fazem nada: {faps}',
  '{point} is not marked': '{point} não está marcado',
  '{first} and {second} are not marked': '{first} e {second} não estão marcados',
  '{first} is not to the left of {second}': '{first} não está à esquerda de {second}',
  '{first} is not above {second}': '{first} não está acima de {second}',
  'FAPs of eyelids and pupils (19-22, 29, 30)': 'FAPs das pálpebras e pupilas (19-22, 29, 30)',
  'FAPs of eyeball thrust and sideways brows (27, 28, 37-40)': 'FAPs do avanço dos olhos e das sobrancelhas para os lados (27, 28, 37-40)',
  'FAPs of brows, cheeks, nose and ears (31-36, 41, 42, 61-68)': 'FAPs das sobrancelhas, bochechas, nariz e orelhas (31-36, 41, 42, 61-68)',
  'FAPs of mouth, jaw and tongue, vertical and forward (3-5, 8-14, 16-18, 44, 46, 51, 52, 55-60)':
    'FAPs da boca, mandíbula e língua, na vertical e para a frente (3-5, 8-14, 16-18, 44, 46, 51, 52, 55-60)',
  'FAPs of mouth, jaw and tongue, sideways (6, 7, 15, 43, 45, 53, 54)': 'FAPs da boca, mandíbula e língua, para os lados (6, 7, 15, 43, 45, 53, 54)',

  // Levels of detail, and shapes of the head's own.
  'there is no level of {budget} vertices: it would not be smaller than the one before by a tenth, because the model has no more or feature points, lips, lids, borders and seams must stay':
    'não há nível de {budget} vértices: ele não seria um décimo menor que o anterior, porque o modelo não tem mais, ou porque pontos característicos, lábios, pálpebras, bordas e costuras têm de ficar',
  'the level of {budget} vertices has {count}: feature points, lips, lids, borders and seams must stay':
    'o nível de {budget} vértices tem {count}: pontos característicos, lábios, pálpebras, bordas e costuras têm de ficar',
  'the head wears its own {sets}': 'a cabeça usa as suas próprias formas: {sets}',
  "it has no shapes for {sets}: the library's are worn": 'ela não tem formas para {sets}: são usadas as da biblioteca',
  "its own shape for {set} is left out, the library's stays: {fault}": 'a sua forma para {set} ficou de fora, a da biblioteca continua: {fault}',
};

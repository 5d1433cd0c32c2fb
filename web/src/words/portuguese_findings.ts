/** What a finding's texts are made of; the server's own words are English. */
export interface FindingFacts {
  points: readonly string[];
  /** Vertices concerned. */
  count: number;
  /** What was measured; NaN: nothing. */
  value: number;
  /** The vertex that a point should be moved to; null: moving no point is the remedy. */
  vertex: number | null;
  /** What was measured, in the server's words: of a unit, its name. */
  what: string;
}

type Say = (facts: FindingFacts) => readonly [words: string, remedy: string];

const list = (names: readonly string[]): string =>
  names.length < 2 ? (names[0] ?? 'um ponto') : `${names.slice(0, -1).join(', ')} e ${names.at(-1)!}`;
const first = ({ points }: FindingFacts): string => points[0] ?? 'um ponto';
const percent = ({ value }: FindingFacts): string => `${Math.round(100 * value)} %`;
const many = (count: number, one: string, more: string): string => (count === 1 ? `1 ${one}` : `${count} ${more}`);
/** Points of the eyes have the group 3; the left ones are odd. */
const isOfEye = (facts: FindingFacts): boolean => first(facts).startsWith('3.');
const side = (facts: FindingFacts): string => (Number(first(facts).split('.')[1]) % 2 === 1 ? 'esquerdo' : 'direito');
/** The lid of a point of its edge. */
const lid = (facts: FindingFacts): string => (Number(first(facts).split('.')[1]) <= 2 ? 'superior' : 'inferior');
/** The FAPs that turn the eye. */
const gaze = (facts: FindingFacts): string => (side(facts) === 'esquerdo' ? '23, 25 e 27' : '24, 26 e 28');
const unit = ({ points }: FindingFacts): string => `A unidade que ${list(points)} medem`;
const belongs = (point: string): string =>
  point === '3.5' ? 'no globo ocular esquerdo' : point === '3.6' ? 'no globo ocular direito' : point.startsWith('6.') ? 'na língua' : 'na pele do rosto';

const leak: Say = (facts) => [
  `${many(facts.count, 'vértice de uma borda segue', 'vértices de uma borda seguem')} os pontos da outra em mais de um décimo, no máximo ${percent(facts)}; a borda se move junto quando só a outra deveria`,
  'Use pesos suaves, que não vazam; com eles, confira a ligação entre as duas bordas e os pontos próximos',
];
const coarse: Say = (facts) => [
  `A borda tem ${many(facts.value, 'aresta', 'arestas')}, vértices de menos entre os seus pontos; ela dobra em cantos, e não em curva`,
  'Subdivida o lugar uma vez, ou use um modelo mais fino',
];

/** The words and the remedy of a finding in Brazilian Portuguese, by its code; core/doctor has the English ones. */
export const portugueseFindings: Readonly<Record<string, Say>> = {
  'upside-down': () => [
    'O rosto está de cabeça para baixo: as sobrancelhas ficam abaixo da boca, e todo movimento vai na direção errada',
    'Gire o modelo para que +Y fique para cima, ou defina os seus eixos',
  ],
  'facing-away': () => [
    'O rosto olha para -Z, para longe da frente: esquerda e direita, frente e trás estão trocadas',
    'Gire o modelo meia-volta em torno do eixo vertical, para que olhe para +Z',
  ],
  'not-upright': ({ value }) => [
    `O rosto está girado em ${Math.round(value)} graus em relação aos eixos do modelo, e os movimentos vão em direções erradas`,
    'Gire o modelo para que +Y fique para cima e o rosto olhe para +Z; se só está um pouco virado, deixe os eixos por conta dos pontos, sem eixos definidos à mão; senão, defina-os',
  ],
  'left-right-swapped': ({ points }) => [
    `Esquerda e direita estão trocadas em ${list(points)}; são as do rosto, não as de quem olha, e estes pontos movem o lado errado`,
    'Troque os pontos de cada par; se todos estão trocados, o próprio modelo pode estar espelhado',
  ],
  'no-points': () => ['Nenhum ponto está marcado, e nada pode se mover', 'Marque ao menos o meio e os cantos da boca, as pálpebras, as pupilas, 9.15 e 2.1'],
  'missing-points': ({ points }) => [
    `${points.length === 1 ? 'Falta' : 'Faltam'} ${list(points)}; o que se move por ${points.length === 1 ? 'este ponto' : 'estes pontos'} fica parado, no todo ou em parte`,
    'Marque o que a cabeça tem, ou deixe que o servidor proponha os pontos a partir dos que já estão marcados',
  ],
  'unit-not-positive': (facts) => [
    `${unit(facts)}, ${facts.what}, é zero ou negativa: os pontos estão na mesma altura ou trocados, e nenhum FAP nessa unidade se move`,
    `Confira ${list(facts.points)}, ou defina a unidade à mão`,
  ],
  'unit-implausible': (facts) => [
    `${unit(facts)} não é a de um rosto: os FAPs nessa unidade movem o rosto demais ou de menos`,
    `Confira ${list(facts.points)}, ou defina a unidade à mão`,
  ],
  'unit-by-hand': (facts) => [
    `${unit(facts)} foi definida à mão`,
    'Se é o que se quer, não é preciso fazer nada; sem o valor à mão, os pontos dão a unidade',
  ],
  'point-refused': (facts) => [`${first(facts)} está num lugar impossível e ficou de fora`, 'Marque o ponto de novo'],
  'point-on-no-surface': (facts) => [`${first(facts)} está num vértice que nenhum triângulo usa, e não tem efeito`, 'Mova-o para o vértice mais próximo do rosto'],
  'point-on-wrong-part': (facts) => [
    `O lugar de ${first(facts)} é ${belongs(first(facts))}, mas o seu vértice é de outra parte; o rosto não o segue`,
    `Mova-o para o vértice mais próximo ${belongs(first(facts))}`,
  ],
  'skin-in-pieces': ({ points }) => [
    `A parte com ${list(points)} é um pedaço do rosto sem ligação com a parte dos outros pontos; nenhum movimento passa de uma à outra, e a pele se rasga`,
    'Junte os pedaços: una os vértices próximos ao longo da borda entre eles',
  ],
  'points-on-one-vertex': ({ points }) => [
    `${list(points)} estão no mesmo vértice, que segue a média deles: nenhum se move por inteiro`,
    'Mova cada um para o seu próprio vértice, ou deixe sem marcar os menos importantes',
  ],
  'point-on-inside': (facts) => [
    `${first(facts)} está numa superfície virada para dentro da cabeça, como a parede interna de uma dupla ou o saco da boca; a pele visível não o segue`,
    'Mova-o para o vértice à frente dele, do lado de fora',
  ],
  'point-on-other-rim': (facts) => {
    const [rim, opening] = isOfEye(facts) ? ['outra pálpebra', 'o olho'] : ['outro lábio', 'a boca'];
    const own = isOfEye(facts) ? 'da sua pálpebra' : 'do seu lábio';
    return [
      `${first(facts)} está ${isOfEye(facts) ? 'na' : 'no'} ${rim}, que segue pontos das duas bordas; ${opening} não abre nem fecha direito`,
      `Mova ${first(facts)} para o vértice ${facts.vertex ?? 'mais próximo'} ${own}`,
    ];
  },
  'point-off-lid-edge': (facts) => [
    `${first(facts)} está na dobra da pálpebra, e não na borda: visto de frente, a pele cobre ${percent(facts)} do caminho até a outra pálpebra; uma piscada deixa o olho aberto e vinca a dobra`,
    `Mova ${first(facts)} para o vértice ${facts.vertex ?? 'mais próximo'} na borda da pálpebra`,
  ],
  'point-on-eye': (facts) => [
    `${first(facts)} está sobre o olho, e não na borda da pálpebra, que fica a ${percent(facts)} da distância entre os olhos dali; o olho é uma só pele com as pálpebras, por isso vai junto, e uma piscada não se fecha sobre ele`,
    `Mova ${first(facts)} para o vértice ${facts.vertex ?? 'mais próximo'}, na borda da pálpebra`,
  ],
  'point-out-of-order': (facts) => [
    `${first(facts)} está do lado errado de ${list(facts.points.slice(1))}, ao contrário do que é em todo rosto, por ${percent(facts)} da distância entre os olhos`,
    `Confira primeiro ${first(facts)}, depois ${list(facts.points.slice(1))}; um ponto pode estar no lugar de outro`,
  ],
  'point-off-mirror': (facts) =>
    facts.points.length < 2
      ? [`O lugar de ${first(facts)} é o meio do rosto, mas ele está a ${percent(facts)} da distância entre os olhos`, 'Mova o ponto para o meio, a não ser que o rosto seja assimétrico']
      : [
          `${list(facts.points)} não são simétricos: um deles está fora do lugar por ${percent(facts)} da distância entre os olhos`,
          'Mova o que está errado, ou deixe que seja preenchido a partir do outro lado, a não ser que o rosto seja assimétrico',
        ],
  'lips-joined': (facts) => [
    `Os lábios estão unidos: o caminho pela superfície atravessa a abertura, com ${percent(facts)} da distância em volta do canto; a boca não abre mais do que a pele entre eles estica, e fecha só até onde dobraria`,
    'Apague as faces que atravessam a abertura, ou separe os vértices que os dois lábios têm em comum; uma cabeça que ali é uma só pele, como um escaneamento, fica assim',
  ],
  'lids-joined': (facts) => [
    `As pálpebras estão unidas: o caminho pela superfície atravessa a abertura, com ${percent(facts)} da distância em volta do canto; o olho fecha só até onde a pele dobraria`,
    'Apague as faces que atravessam a abertura, ou separe os vértices que as duas pálpebras têm em comum; uma cabeça que ali é uma só pele, como um escaneamento, fica assim',
  ],
  'lips-leak': leak,
  'lids-leak': leak,
  'mouth-open': (facts) => [
    `A boca está aberta em ${percent(facts)} da distância entre os olhos, mas no rosto neutro os lábios se tocam; p, b e m não a fecham`,
    'Exporte o modelo com a boca fechada, ou confira se 2.2 e 2.3 estão nas bordas internas dos lábios',
  ],
  'eye-not-open': (facts) => [
    `O olho ${side(facts)} não está aberto: entre as pálpebras há ${percent(facts)} da distância entre os olhos, mas no rosto neutro elas tocam a íris; um olho fechado abre com valores negativos dos FAPs 19 a 22`,
    `Exporte o modelo com os olhos abertos, ou confira se ${list(facts.points)} estão nas bordas das pálpebras; IRISD também pode ser definida à mão`,
  ],
  'mouth-too-coarse': coarse,
  'eye-too-coarse': coarse,
  'face-too-dense': () => [
    'Uma borda do rosto é mais fina do que uma tela mostra; cada cliente processa vértices sem efeito visível',
    'Reduza o modelo antes de enviá-lo, ou deixe que os clientes busquem um nível de detalhe menor',
  ],
  'idle-part': (facts) => [
    `${many(facts.count, 'vértice sem papel está', 'vértices sem papel estão')} no rosto que se move, perto de ${first(facts)}, e nenhum ponto os influencia; ficam parados enquanto a pele sob eles se move`,
    'Dê um papel à parte (Preso, se fica sobre a pele), junte-a à pele, ou marque pontos nela',
  ],
  'second-skin': (facts) => [
    `Uma parte está perto de ${percent(facts)} dos pontos do rosto, como uma segunda pele ou um segundo nível de detalhe; os pontos não estão nela, e ela aparece através do rosto que se move`,
    'Exporte o modelo com uma pele só',
  ],
  'eye-cannot-turn': (facts) => [
    `Nenhuma parte é o globo ocular ${side(facts)}, e os FAPs ${gaze(facts)} não têm efeito`,
    'Dê este papel à parte do globo ocular, e separe-a antes da pele se as duas estão unidas; um olho pintado na pele não gira',
  ],
  'eye-welded': (facts) => [
    `O globo ocular ${side(facts)} está soldado às pálpebras: não gira, os FAPs ${gaze(facts)} não têm efeito, e pálpebras que se fecham sobre ele deixam fendas finas onde têm vértices em comum`,
    'Separe os vértices que o globo ocular e as pálpebras têm em comum, ou exporte a cabeça sem unir vértices próximos; o globo ocular é então uma parte própria',
  ],
  'lids-in-eye': (facts) => [
    `A borda da pálpebra ${lid(facts)} do olho ${side(facts)} está dentro do globo ocular, a uma profundidade de ${percent(facts)} do raio: vê-se o globo através da pálpebra, também quando ela se fecha`,
    'Mova o globo ocular para trás, diminua-o ou traga a pálpebra para a frente, até que toda a borda fique à frente dele',
  ],
  'hole-near-points': (facts) => [`A pele tem um buraco ao lado de ${first(facts)}; a influência passa em volta dele, e o fundo aparece`, 'Feche o buraco no programa que fez o modelo'],
  'inside-out': () => [
    'A maior parte está do avesso: os seus triângulos olham para dentro, e vê-se o verso em vez da frente',
    'Inverta as faces, ou recalcule as normais para fora, no programa que fez o modelo',
  ],
  'inconsistent-winding': () => [
    'Triângulos vizinhos da pele têm orientações opostas; um dos lados aparece escuro ou não aparece',
    'Recalcule as normais para fora no programa que fez o modelo',
  ],
  'open-seam': () => [
    'Bordas da pele estão lado a lado sem se unirem; a pele está cortada ali, e nenhum movimento passa pelo corte',
    'Una os vértices próximos ao longo da costura; lábios e pálpebras que só se tocam podem ficar como estão',
  ],
  'non-manifold-edges': () => [
    'Há arestas que unem mais de dois triângulos; a influência passa ali para superfícies que deveriam se separar',
    'Separe as superfícies que se encontram ali, ou apague as faces internas entre elas',
  ],
  'duplicate-triangles': () => [
    'Há triângulos exatamente sobre outros; ambos são desenhados e cintilam',
    'Apague as faces duplicadas; para que uma superfície seja vista por trás, torne o seu material de dois lados',
  ],
  'degenerate-triangles': () => [
    'Há triângulos sem área; não são desenhados, e só as suas arestas levam influência',
    'Dissolva as faces degeneradas no programa que fez o modelo e exporte-o de novo',
  ],
  'unused-vertices': ({ count }) => [
    `${many(count, 'vértice não é', 'vértices não são')} de nenhum triângulo; o pacote os deixa de fora`,
    'Não é preciso fazer nada; vértices sem uso podem ser apagados antes de exportar',
  ],
  'far-vertices': ({ count, value }) => [
    `${many(count, 'vértice está', 'vértices estão')} longe do rosto, no máximo a ${Math.round(value)} vezes a distância entre os olhos, esquecidos ou alheios à cabeça; cada cliente também os recebe`,
    'Apague o que não é da cabeça no programa que fez o modelo',
  ],
  'coarse-coordinates': (facts) => [
    `A cabeça está tão longe da origem do arquivo que as suas coordenadas têm degraus de ${percent(facts)} da distância entre os olhos; o rosto é desenhado em degraus, e pontos próximos coincidem`,
    'Mova a cabeça para a origem no programa que fez o modelo e exporte-o de novo',
  ],
};

const measures: Readonly<Record<string, string>> = {
  "cosine between the surface's normal and the outward direction of the face": 'cosseno entre a normal da superfície e a direção para fora do rosto',
  "degrees between the face's axes and the model's": 'graus entre os eixos do rosto e os do modelo',
  "degrees between the face's plane of symmetry and the model's": 'graus entre o plano de simetria do rosto e o do modelo',
  "depth of the edge as a fraction of the eyeball's radius": 'profundidade da borda como fração do raio do globo ocular',
  'distance from the face as a multiple of ES0': 'distância do rosto como múltiplo de ES0',
  'distance from the edge of the lids as a fraction of ES0': 'distância da borda das pálpebras como fração de ES0',
  'distance from the symmetric place as a fraction of ES0': 'distância do lugar simétrico como fração de ES0',
  'distance of the lids as a fraction of ES0': 'distância entre as pálpebras como fração de ES0',
  'distance on the wrong side as a fraction of ES0': 'distância do lado errado como fração de ES0',
  'distance to the point as a fraction of ES0': 'distância do ponto como fração de ES0',
  'edges of the rim': 'arestas da borda',
  "fraction of the face's points close to it": 'fração dos pontos do rosto perto dela',
  'height of 2.2 above 2.3 as a fraction of ES0': 'altura de 2.2 acima de 2.3 como fração de ES0',
  "largest weight of the other's points": 'maior peso dos pontos da outra borda',
  'mean edge length of the rim as a fraction of ES0': 'comprimento médio das arestas da borda como fração de ES0',
  'path across as a fraction of the distance around the nearer corner': 'caminho através como fração da distância em volta do canto mais próximo',
  'skin seen between the point and the eyeball as a fraction of the distance of the lids': 'pele vista entre o ponto e o globo ocular como fração da distância entre as pálpebras',
  'step of the coordinates as a fraction of ES0': 'degrau das coordenadas como fração de ES0',
  'volume as a fraction of the sum of its pieces': 'volume como fração da soma dos seus pedaços',
  'widest gap as a fraction of the length of a border edge': 'maior vão como fração do comprimento de uma aresta da borda',
};

/** What a finding measures, by the server's words; of a unit "MW as a fraction of ES0". */
export const portugueseMeasure = (english: string): string =>
  measures[english] ?? english.replace(/ as a fraction of ES0$/, ' como fração de ES0');

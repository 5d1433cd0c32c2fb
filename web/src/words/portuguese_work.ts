import type { Sentences } from './server_sentences.ts';

/** Stages of jobs, doubts about proposed points and why there are none, in Brazilian Portuguese by their English form. */
export const portugueseWork: Sentences = {
  // What a job does, beside `stageTitles`.
  starting: 'começando',
  reading: 'lendo o arquivo',
  'reading the expression': 'lendo a expressão',
  'feature points': 'pontos característicos',
  preview: 'preparando a prévia',
  'levels of detail': 'níveis de detalhe',
  'measuring levels': 'medindo os níveis',
  'regions of influence': 'regiões de influência',
  'fit to own shapes': 'ajustando às formas próprias',
  displacements: 'deslocamentos',
  writing: 'gravando',
  saving: 'salvando',
  cancelling: 'cancelando',
  done: 'pronto',
  'waiting for the disk': 'esperando pelo disco',
  'waiting for disk space': 'esperando espaço no disco',

  // What has no weights of this kind.
  "fitted weights need shapes of the head's own (morph targets), and the model has none: choose smooth":
    'pesos ajustados precisam de formas da própria cabeça (morph targets), e o modelo não tem nenhuma: escolha os suaves',
  'fitted weights need shapes that move some feature points and leave others at rest, and none of the {count} morph targets of the model does: choose smooth':
    'pesos ajustados precisam de formas que movem uns pontos característicos e deixam outros em repouso, e nenhum dos {count} morph targets do modelo é assim: escolha os suaves',
  'the bytes of the model cannot be read': 'os bytes do modelo não podem ser lidos',

  // Points that are not proposed.
  '{fault}; next of the quick set: {points}': '{fault}; próximos do conjunto rápido: {points}',
  'no reference head has this point': 'nenhuma cabeça de referência tem este ponto',
  'the thickness of the hair cannot be derived from the face': 'a espessura do cabelo não pode ser deduzida do rosto',
  'the model has no {role}': 'o modelo não tem {role}',
  'left eye': 'olho esquerdo',
  'right eye': 'olho direito',
  'upper teeth': 'dentes superiores',
  'lower teeth': 'dentes inferiores',
  tongue: 'língua',
  skin: 'pele',
  'every vertex of the {role} already has a point': 'todo vértice desta parte ({role}) já tem um ponto',
  'the model has no surface at the expected position': 'o modelo não tem superfície na posição esperada',
  'the surface has no free vertex that fits this point at its expected position': 'a superfície não tem, na posição esperada, um vértice livre que sirva para este ponto',

  // Doubts about a proposed point.
  'the surface is too coarse here to distinguish {sides}': 'aqui a superfície é grosseira demais para distinguir {sides}',
  'no placed point on this piece distinguishes {sides}': 'nenhum ponto marcado nesta peça distingue {sides}',
  'too few points are placed to distinguish {sides}': 'há poucos pontos marcados para distinguir {sides}',
  'the surface has no vertex on the side of this point that distinguishes {sides}': 'a superfície não tem, do lado deste ponto, um vértice que distinga {sides}',
  'the surface connects both directly here and does not distinguish {sides}': 'aqui a superfície liga os dois diretamente e não distingue {sides}',
  'the {upper} from the {lower}': 'entre {upper} e {lower}',
  'upper lip': 'o lábio superior',
  'lower lip': 'o lábio inferior',
  'upper lid': 'a pálpebra superior',
  'lower lid': 'a pálpebra inferior',
  'no free vertex near here keeps the order in which the points stand on a face': 'nenhum vértice livre perto daqui mantém a ordem dos pontos num rosto',
};

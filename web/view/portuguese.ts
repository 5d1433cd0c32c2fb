import type { ViewWords } from './words.ts';

export const portuguese: ViewWords = {
  page: {
    noStream: 'Falta o nome do fluxo: o endereço desta página termina com o nome de um fluxo, como em /view/demo.',
    captions: 'Legendas',
    play: 'Reproduzir',
    pause: 'Pausar',
    connection: { none: '', good: 'Conexão boa', fair: 'Conexão lenta', poor: 'Conexão ruim', lost: 'Sem conexão' },
  },
  face: {
    play: 'Reproduzir',
    soundOn: 'Ligar o som',
    soundOff: 'Desligar o som',
    noSound: 'Sem som neste navegador',
    voiceOn: 'Ligar a voz',
    voiceOff: 'Desligar a voz',
    face: (stream) => `Rosto animado${stream && `, fluxo ${stream}`}`,
    trouble: {
      address: (name) => `“${name}” não é o endereço de um servidor. Ele começa com https:// ou http://, ou é um caminho no servidor desta página.`,
      'no-stream': (name) => `Não há fluxo “${name}” neste servidor.`,
      'no-model': (name) => `O fluxo “${name}” ainda não tem rosto. Ele aparece assim que um modelo for escolhido.`,
      'model-unready': () => 'Este rosto não existe, ou ainda está sendo preparado.',
      private: () => 'Este fluxo é privado. Abra-o com o link do seu convite.',
      unreachable: () => 'O servidor não responde. Nova tentativa em andamento.',
      library: () => 'Esta página não conseguiu carregar a sua parte que desenha rostos. Nova tentativa em andamento.',
      policy: (name) => `As regras desta página proíbem que ela carregue de ${name}.`,
      server: () => 'O servidor está com um problema. Nova tentativa em andamento.',
      damaged: () => 'Não foi possível carregar este rosto: os arquivos não combinam entre si.',
      'no-webgl': () => 'Este navegador não tem WebGL 2, necessário para desenhar um rosto. Ative a aceleração de hardware ou use outro navegador.',
      ended: () => 'O fluxo terminou.',
      lost: () => 'A conexão caiu. Nova tentativa em andamento.',
    },
  },
};

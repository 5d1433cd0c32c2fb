import type { Confidence, PointProposal } from '../../face/point_draft.ts';
import { serverWords, t } from '../../words/words.ts';

const methods: Record<string, string> = {
  mirror: t('mirrored from the other side'),
  proportion: t('from the proportions of heads'),
  shape: t('from the shape of the head'),
};

/** The state of a point, for those who do not see its colour. */
export const pointStateWords = {
  open: t('not placed'),
  proposed: t('proposed'),
  placed: t('placed'),
  changed: t('changed'),
  wrong: t('wrong'),
} as const;

export const confidenceWords: Record<Confidence, string> = { high: t('sure'), medium: t('fairly sure'), low: t('unsure') };

/** "Proposed from the shape of the head: fairly sure, expected within 9 % of the eye distance." */
export function proposalWords({ method, confidence, expectedError, remark }: PointProposal): string {
  const how = method === null ? '' : ` ${methods[method] ?? method}`;
  const sure = confidence === null ? '' : `: ${confidenceWords[confidence]}`;
  const off =
    expectedError === null ? '' : t(', expected within {expectedError} % of the eye distance', { expectedError: Math.ceil(expectedError * 100) });
  const look = remark === undefined ? '' : t(' Look closely: {remark}.', { remark: serverWords(remark) });
  return t('Proposed{how}{sure}{off}.{look}', { how, sure, off, look });
}

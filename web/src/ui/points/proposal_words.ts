import type { Confidence, PointProposal } from '../../face/point_draft.ts';

const methods: Record<string, string> = {
  mirror: 'mirrored from the other side',
  proportion: 'from the proportions of heads',
  shape: 'from the shape of the head',
};

export const confidenceWords: Record<Confidence, string> = { high: 'sure', medium: 'fairly sure', low: 'unsure' };

/** "Proposed from the shape of the head: fairly sure, expected within 9 % of the eye distance." */
export function proposalWords({ method, confidence, expectedError, remark }: PointProposal): string {
  const how = method === null ? '' : ` ${methods[method] ?? method}`;
  const sure = confidence === null ? '' : `: ${confidenceWords[confidence]}`;
  const off =
    expectedError === null ? '' : `, expected within ${Math.ceil(expectedError * 100)} % of the eye distance`;
  const look = remark === undefined ? '' : ` Look closely: ${remark}.`;
  return `Proposed${how}${sure}${off}.${look}`;
}

import type { Model } from '../../src/net/types.ts';

/** A head that has been uploaded and not been read yet. */
export const importingModel = (more: Partial<Model> = {}): Model => ({
  id: 'm',
  name: 'Ada',
  state: 'importing',
  problem: null,
  created: '2026-01-01T00:00:00Z',
  updated: '2026-01-01T00:00:00Z',
  source: { format: null, file_name: 'ada.glb', bytes: 2_000_000, sha256: '' },
  counts: { vertices: 0, triangles: 0, parts: 0 },
  bounds: null,
  parts: [],
  frame: null,
  expressions: {},
  morph_targets: [],
  warnings: [],
  findings: null,
  feature_point_count: 0,
  package: null,
  links: { self: '/v1/models/m', feature_points: '/v1/models/m/feature-points', preview: null, report: null },
  ...more,
});

import { pointById } from '../../face/feature_points.ts';
import { littleWeight, type Coverage } from '../../face/influence_map.ts';
import {
  coveredColour,
  heatGradient,
  littleColour,
  regionColours,
  restColour,
  uncoveredColour,
  type Rgb,
} from '../../face/influence_palette.ts';
import { h, replace, type Child } from '../shared/dom.ts';
import { formatCount } from '../shared/format.ts';
import type { Signal } from '../shared/signal.ts';
import type { SceneView } from '../stage/scene.ts';
import { swatch } from './swatch.ts';
import { percent, pointName, type InfluenceModel } from './influence_model.ts';
import { t } from '../../words/words.ts';

/** What the colours on the stage mean, at the edge of the stage. */
export function influenceLegend(model: InfluenceModel, scene: SceneView): HTMLElement {
  const element = h('div', { class: 'legend', role: 'group', 'aria-label': t('Legend of the influence view') });
  const draw = (): void => {
    element.hidden = !model.on.value || !scene.faceShown.value;
    if (element.hidden) return;
    element.dataset['mode'] = model.mode.value;
    replace(element, content(model));
  };
  for (const signal of [model.on, model.mode, model.chosen, model.fap, model.coverage, scene.faceShown] as Signal<unknown>[])
    signal.watch(draw);
  return element;
}

function content(model: InfluenceModel): Child[] {
  switch (model.mode.value) {
    case 'heat':
      return [h('strong', {}, heatTitle(model)), scale(), row(restColour, t('None'))];
    case 'regions':
      return [
        h('strong', {}, t('Regions')),
        model.chosen.value.map((id, i) => row(regionColours[i % regionColours.length]!, id, pointName(id))),
        row(restColour, t('Others')),
      ];
    case 'strongest':
      return [
        h('strong', {}, t('Strongest point')),
        h('p', {}, t('A colour is the region where one point counts most.')),
        row(restColour, t('No point')),
      ];
    case 'uncovered':
      return [h('strong', {}, t('Uncovered')), coverageRows(model.coverage.value)];
  }
}

function heatTitle({ fap, chosen }: InfluenceModel): string {
  if (fap.value !== null) return t('FAP {value}', { value: fap.value });
  const ids = chosen.value;
  if (ids.length === 0) return t('Choose a point');
  return ids.length === 1 ? t('Point {id}', { id: pointById(ids[0]!)?.id ?? '' }) : t('{count} points together', { count: ids.length });
}

/** The scale of weights with its numbers, from 100 % at the top. */
function scale(): HTMLElement {
  const ramp = h('span', { class: 'legend-ramp' });
  ramp.style.backgroundImage = heatGradient('to top');
  return h(
    'div',
    { class: 'legend-scale', role: 'img', 'aria-label': t('Weight, from 0 % dark violet to 100 % yellow') },
    ramp,
    h(
      'span',
      { class: 'legend-numbers', 'aria-hidden': 'true' },
      [1, 0.75, 0.5, 0.25, 0].map((weight) => h('span', {}, percent(weight))),
    ),
  );
}

function coverageRows(coverage: Coverage | null): Child {
  if (!coverage) return null;
  const { vertices, none, little } = coverage;
  const covered = vertices - none - little;
  const share = (count: number): string => `${formatCount(count)} · ${percent(count / Math.max(vertices, 1))}`;
  return [
    row(uncoveredColour, t('No point'), share(none), true),
    row(littleColour, `< ${percent(littleWeight)}`, share(little)),
    row(coveredColour, t('Covered'), share(covered)),
    row(restColour, t('Not skin')),
  ];
}

function row(colour: Rgb, label: string, note = '', hatched = false): HTMLElement {
  return h(
    'div',
    { class: 'legend-row' },
    swatch(colour, hatched),
    h('span', {}, label),
    note ? h('small', {}, note) : null,
  );
}

import type { Finding } from '../../net/types.ts';
import { DoctorPanel } from './doctor_panel.ts';
import { h } from '../shared/dom.ts';
import type { FindingAction } from './finding_actions.ts';
import type { FitModel } from './fit_model.ts';
import { FramePanel } from './frame_panel.ts';
import { mendButton } from './mend.ts';
import { ParametrizeBox } from '../points/parametrize_box.ts';
import type { Parametrizer } from '../points/parametrizer.ts';
import { PartsPanel } from './parts_panel.ts';
import type { PointsModel } from '../points/points_model.ts';
import type { Studio } from '../shared/studio.ts';

/** The Fit tab: findings of the fit doctor, unit and axes, and parts of the open head. */
export class FitPanel {
  readonly element: HTMLElement;
  private readonly frame: FramePanel;
  private readonly parts: PartsPanel;

  constructor(
    private readonly studio: Studio,
    private readonly points: PointsModel,
    fit: FitModel,
    parametrizer: Parametrizer,
  ) {
    const doctor = new DoctorPanel(studio, fit, {
      enoughPoints: () => points.canPropose,
      onAction: (action, finding) => this.act(action, finding),
    });
    let enough = points.canPropose;
    points.changed.watch(() => {
      if (points.canPropose === enough) return;
      enough = points.canPropose;
      doctor.draw();
    });
    this.frame = new FramePanel(studio);
    this.parts = new PartsPanel(studio, fit);
    this.element = h(
      'div',
      { class: 'panel fit' },
      doctor.element,
      mendButton(studio, fit, parametrizer),
      this.frame.element,
      this.parts.element,
      new ParametrizeBox(studio, points, parametrizer, { withSave: false }).element,
    );
  }

  /** Scrolls to a part's row. */
  revealPart(part: number): void {
    this.parts.reveal(part, false);
  }

  private act(action: FindingAction, finding: Finding): void {
    const { points, studio } = this;
    switch (action.kind) {
      case 'role':
        return this.parts.reveal(action.part, true);
      case 'point':
        studio.tab.set('points');
        return points.chosen.set(action.point);
      case 'move':
        studio.tab.set('points');
        return points.move(action.move.point, { vertex: action.move.vertex, position: action.move.position });
      case 'exchange':
        studio.tab.set('points');
        return points.exchange(finding.place.points);
      case 'propose':
        studio.tab.set('points');
        return void points.propose();
      case 'mark':
        studio.tab.set('points');
        points.guide(true);
        return points.chooseNext();
      case 'axes':
        return this.frame.reveal();
    }
  }
}

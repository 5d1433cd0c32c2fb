import { wordsOf } from '../../net/problem.ts';
import type { Model } from '../../net/types.ts';
import { CameraLink } from '../../view/camera_link.ts';
import { InfluenceModel } from '../influence/influence_model.ts';
import { h, replace, setText } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import type { SceneView } from '../stage/scene.ts';
import { differenceFrom, faceCaption, type ShownFace } from './face_caption.ts';
import { t } from '../../words/words.ts';

export interface CompareOptions {
  /** The first view, whose camera, colours and motion the second one shares. */
  scene: SceneView;
  influence: InfluenceModel;
  driver: FaceDriver;
  makeScene: (canvas: HTMLCanvasElement) => SceneView;
  onClose: () => void;
}

/** A second face beside the one on the stage: seen from the same side, in the same frame, painted alike. */
export class CompareView {
  readonly element: HTMLElement;
  readonly scene: SceneView;
  private readonly label = h('span', { class: 'compare-text' });
  private readonly message = h('p', { class: 'compare-message', role: 'status' });
  private readonly influence: InfluenceModel;
  private readonly ends: (() => void)[];

  constructor(private readonly options: CompareOptions) {
    const { scene, driver } = options;
    const canvas = h('canvas', { class: 'twin-canvas', role: 'img' });
    this.element = h(
      'div',
      { class: 'compare-view', role: 'region', 'aria-label': t('The face beside it') },
      canvas,
      this.message,
      h(
        'div',
        { class: 'stage-top' },
        h(
          'div',
          { class: 'compare-label' },
          this.label,
          h(
            'button',
            { type: 'button', class: 'quiet square', 'aria-label': t('Close the second view'), on: { click: options.onClose } },
            icon('close', 16),
          ),
        ),
      ),
    );
    this.scene = options.makeScene(canvas);
    this.influence = new InfluenceModel(this.scene, options.influence);
    scene.joinTwin(this.scene);
    this.scene.clock = () => scene.performer.value?.player.playhead ?? NaN;
    this.scene.animate = () => driver.twinMoved;
    const link = new CameraLink(scene.stage, this.scene.stage);
    this.scene.stage.onFrame(() => {
      link.step();
      return false;
    });
    this.ends = [
      this.influence.followLeader(),
      this.scene.performer.watch((performer) => {
        link.reset(); // a new face stands in front of its camera
        driver.setTwin(performer);
      }),
      this.scene.state.watch((state) => {
        this.message.hidden = state.kind === 'ready';
        const words = state.kind === 'failed' ? wordsOf(state.problem) : t('Opening the head');
        replace(this.message, state.kind === 'failed' ? null : h('span', { class: 'spinner', 'aria-hidden': 'true' }), h('span', {}, words));
      }),
    ];
  }

  /** Shows a level of a head's face package. Resolves with whether it is shown. */
  async open(model: Model, level: number): Promise<boolean> {
    await this.scene.open(model, level);
    return this.scene.state.value.kind === 'ready';
  }

  /** Says what is shown: over the picture, what tells it from the first view. */
  name(face: ShownFace, first: ShownFace): void {
    setText(this.label, differenceFrom(face, first));
    this.label.title = faceCaption(face);
    this.element.querySelector('canvas')!.setAttribute('aria-label', faceCaption(face));
  }

  dispose(): void {
    for (const end of this.ends) end();
    this.options.scene.joinTwin(null);
    this.options.driver.setTwin(null);
    this.scene.dispose();
    this.element.remove();
  }
}

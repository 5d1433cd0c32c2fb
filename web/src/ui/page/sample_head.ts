import { requestBytes } from '../../net/http.ts';
import type { FeaturePointsBody } from '../../net/types.ts';
import type { Parametrizer } from '../points/parametrizer.ts';
import type { PointsModel } from '../points/points_model.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/** The sample head and its feature points, served with the page. */
const file = './sample/sample-head.glb';
const pointsFile = './sample/sample-head.fps.json';

/** Uploads the sample head with its feature points and makes it move, for a server without heads. */
export async function addSampleHead(studio: Studio, points: PointsModel, parametrizer: Parametrizer): Promise<void> {
  await studio.attempt(t('The sample head could not be added'), async () => {
    const [head, text] = await Promise.all([requestBytes(file), requestBytes(pointsFile)]);
    const name = `${t('Sample head')}.glb`;
    await studio.upload([{ path: name, file: new File([head as BlobPart], name) }]);
    const { value: model } = studio.selected;
    if (model?.state !== 'ready') return; // why, is on the screen
    await studio.api.putFeaturePoints(model.id, JSON.parse(new TextDecoder().decode(text)) as FeaturePointsBody);
    await points.open(model);
    await parametrizer.run();
  });
}

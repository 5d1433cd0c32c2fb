import { quickSet as ids } from '@protocol/generated/mpeg4.ts';
import { t } from '../words/words.ts';

/** A description of the place of each point of the quick set. */
const hints: Record<string, string> = {
  '9.3': t('The tip of the nose. Turn the head to the side to see it.'),
  '9.15': t('In the middle, under the nose, where it meets the upper lip.'),
  '8.1': t('In the middle of the upper edge of the mouth, in the dip of the lip’s bow.'),
  '2.2': t('In the middle of the upper lip, where the lips meet.'),
  '2.3': t('In the middle of the lower lip, where the lips meet; just below the previous point.'),
  '8.2': t('In the middle of the lower edge of the lower lip, where its red ends.'),
  '2.1': t('The lowest point of the chin, in the middle.'),
  '11.4': t('The highest point of the head, under the hair.'),
  '3.11': t('The corner of the left eye beside the nose. Left is the face’s own: on the right of the picture.'),
  '3.7': t('The outer corner of the left eye, towards the ear.'),
  '3.1': t('On the edge of the upper lid of the left eye, above the pupil.'),
  '3.3': t('On the edge of the lower lid of the left eye, below the pupil.'),
  '3.12': t('The outer corner of the right eye: the only point on this side of the face.'),
  '4.1': t('The end of the left eyebrow beside the nose.'),
  '4.5': t('The outer end of the left eyebrow.'),
  '9.1': t('The outermost point of the left wing of the nose.'),
  '8.3': t('The left corner of the mouth, at the outer edge of the lips.'),
  '2.13': t('Below the left ear, where the jaw turns from the chin up to the ear.'),
  '10.1': t('The highest point of the left ear.'),
  '10.5': t('The lowest point of the lobe of the left ear.'),
};

/** The points to mark first, in this order: the server proposes the others from them. */
export const quickSet: readonly { id: string; hint: string }[] = ids.map((id) => ({ id, hint: hints[id] ?? '' }));

/** The minimum number of placed points from which the server makes proposals. */
export const leastKnownPoints = 8;

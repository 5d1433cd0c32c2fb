/**
 * The points to mark first, in that order, and where each lies in words: the quick set of core/propose, from which the
 * rest are proposed.
 */
export const quickSet: readonly { id: string; hint: string }[] = [
  { id: '9.3', hint: 'The foremost point of the nose. Turn the head to the side to see it.' },
  { id: '9.15', hint: 'In the middle, under the nose, where it meets the upper lip.' },
  { id: '8.1', hint: 'In the middle of the upper edge of the mouth, in the dip of the lip’s bow.' },
  { id: '2.2', hint: 'In the middle of the upper lip, where the lips meet.' },
  { id: '2.3', hint: 'In the middle of the lower lip, where the lips meet; just below the one before.' },
  { id: '8.2', hint: 'In the middle of the lower edge of the lower lip, where its red ends.' },
  { id: '2.1', hint: 'The lowest point of the chin, in the middle.' },
  { id: '11.4', hint: 'The highest point of the head, under the hair.' },
  { id: '3.11', hint: 'The corner of the left eye beside the nose. Left is the face’s own: on the right of the picture.' },
  { id: '3.7', hint: 'The outer corner of the left eye, towards the ear.' },
  { id: '3.1', hint: 'On the edge of the upper lid of the left eye, above the pupil.' },
  { id: '3.3', hint: 'On the edge of the lower lid of the left eye, below the pupil.' },
  { id: '3.12', hint: 'The outer corner of the right eye: the only point on this side of the face.' },
  { id: '4.1', hint: 'The end of the left eyebrow beside the nose.' },
  { id: '4.5', hint: 'The outer end of the left eyebrow.' },
  { id: '9.1', hint: 'Where the wing of the nose goes furthest out, on the left.' },
  { id: '8.3', hint: 'The left corner of the mouth, at the outer edge of the lips.' },
  { id: '2.13', hint: 'Below the left ear, where the jaw turns from the chin up to the ear.' },
  { id: '10.1', hint: 'The highest point of the left ear.' },
  { id: '10.5', hint: 'The lowest point of the lobe of the left ear.' },
];

/** From fewer placed points than this the server proposes nothing. */
export const leastKnownPoints = 8;

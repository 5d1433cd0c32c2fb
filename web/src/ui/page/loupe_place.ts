export interface Place {
  x: number;
  y: number;
}

/**
 * The middle of a loupe of this `radius` beside a finger, `gap` or more from its middle, inside a picture of `width` by `height`:
 * above the finger, where the hand does not cover it; where there is no room, to the side that has more. Writes into `place`.
 */
export function placeLoupe(finger: Place, width: number, height: number, radius: number, gap: number, place: Place): void {
  const away = radius + gap;
  const within = (value: number, size: number): number => Math.max(radius, Math.min(value, size - radius));
  if (finger.y - away >= radius) {
    place.x = within(finger.x, width);
    place.y = finger.y - away;
    return;
  }
  const left = finger.x > width / 2;
  place.x = left ? finger.x - away : finger.x + away;
  place.y = within(finger.y, height);
}

/** Resonances of a throat that is open as in "a": Hz, and their widths. */
const openThroat = [
  [730, 80],
  [1200, 90],
  [2500, 120],
] as const;

/** A voice of 120 Hz that says "a" for this many seconds, greatest value 1: pulses through the resonances of the throat (Klatt 1980). */
export function vowel(rate: number, seconds: number): Float64Array {
  const count = Math.round(seconds * rate);
  const samples = new Float64Array(count);
  const fade = rate / 20;
  for (let n = 0, flow = 0; n < count; n += 1) {
    flow = 0.97 * flow + (n % Math.round(rate / 120) === 0 ? 1 : 0);
    samples[n] = flow * Math.min(1, n / fade, (count - n) / fade);
  }
  for (const [hz, width] of openThroat) {
    const c = -Math.exp((-2 * Math.PI * width) / rate);
    const b = 2 * Math.exp((-Math.PI * width) / rate) * Math.cos((2 * Math.PI * hz) / rate);
    for (let n = 0, one = 0, two = 0; n < count; n += 1) {
      const out: number = (1 - b - c) * samples[n]! + b * one + c * two;
      [two, one] = [one, out];
      samples[n] = out;
    }
  }
  const most = samples.reduce((a, b) => Math.max(a, Math.abs(b)), 0);
  return samples.map((value) => value / most);
}

import type { DrawableMesh } from '@client/gpu/drawable_mesh.ts';
import { isSkinLike } from '@client/gpu/studio_look.ts';
import { featurePointCount, featurePoints } from '@protocol/generated/mpeg4.ts';
import type { RigMaterial } from '@protocol/rig_document.ts';
import { eyeOf, rigidMotion } from '@protocol/weights_format.ts';
import {
  coveredColour,
  littleColour,
  regionColours,
  restColour,
  uncoveredColour,
  type Rgb,
} from './influence_palette.ts';

/** The rows of the influence table; see DrawableMesh. */
export type InfluenceRows = Pick<DrawableMesh, 'vertexCount' | 'rowOffsets' | 'rowPoints' | 'rowWeights'>;

/** A vertex that follows points by less than this in all follows little. */
export const littleWeight = 0.5;

export interface Influencer {
  /** Dense index of the feature point. */
  point: number;
  weight: number;
}

/** The points that a vertex follows, the strongest first. */
export function influencersOf(rows: InfluenceRows, vertex: number): Influencer[] {
  const found: Influencer[] = [];
  for (let k = rows.rowOffsets[vertex]!; k < rows.rowOffsets[vertex + 1]!; k += 1)
    if (rows.rowWeights[k]! > 0) found.push({ point: rows.rowPoints[k]!, weight: rows.rowWeights[k]! });
  return found.sort((a, b) => b.weight - a.weight);
}

/** Whether a vertex is to follow points by weights: eyes and the tongue have motions of their own. */
const followsPoints = (rigid: number): boolean => eyeOf(rigid) < 0 && rigid < rigidMotion.tongue;

/** Points that move at least one vertex, by dense index. */
export function movingPoints(rows: InfluenceRows): boolean[] {
  const moving = new Array<boolean>(featurePointCount).fill(false);
  rows.rowWeights.forEach((weight, k) => {
    if (weight > 0) moving[rows.rowPoints[k]!] = true;
  });
  return moving;
}

/** Per vertex: the strongest point's dense index; -1 where no point has weight. Of equals the first. */
export function strongestPoints(rows: InfluenceRows): Int16Array {
  const strongest = new Int16Array(rows.vertexCount).fill(-1);
  for (let v = 0; v < rows.vertexCount; v += 1) {
    let most = 0;
    for (let k = rows.rowOffsets[v]!; k < rows.rowOffsets[v + 1]!; k += 1) {
      if (rows.rowWeights[k]! <= most) continue;
      most = rows.rowWeights[k]!;
      strongest[v] = rows.rowPoints[k]!;
    }
  }
  return strongest;
}

/**
 * By point: a number of `regionColours`, such that regions that touch differ, and a point has the colour of its mirror
 * point where it can. More neighbours than colours: the colour that fewest neighbours have.
 */
export function colourRegions(strongest: Int16Array, indices: Uint32Array): Uint8Array {
  const touching = Array.from({ length: featurePointCount }, () => new Set<number>());
  for (let i = 0; i + 2 < indices.length; i += 3) {
    for (let k = 0; k < 3; k += 1) {
      const a = strongest[indices[i + k]!]!;
      const b = strongest[indices[i + ((k + 1) % 3)]!]!;
      if (a < 0 || b < 0 || a === b) continue;
      touching[a]!.add(b);
      touching[b]!.add(a);
    }
  }
  const none = 255;
  const colours = new Uint8Array(featurePointCount).fill(none);
  const indexOf = new Map(featurePoints.map(({ id }, i) => [id, i]));
  // Those with the most neighbours first: they have the least choice.
  const order = [...touching.keys()].sort((a, b) => touching[b]!.size - touching[a]!.size || a - b);
  const taken = new Uint16Array(regionColours.length);
  for (const point of order) {
    if (colours[point] !== none) continue;
    const twin = indexOf.get(featurePoints[point]!.mirror)!;
    const pair = colours[twin] === none && !touching[point]!.has(twin) ? [point, twin] : [point];
    for (const some of [pair, [point]]) {
      taken.fill(0);
      for (const one of some) for (const other of touching[one]!) if (colours[other] !== none) taken[colours[other]!]! += 1;
      const least = Math.min(...taken);
      if (least > 0 && some.length > 1) continue; // no colour is free for both
      for (const one of some) colours[one] = taken.indexOf(least);
      break;
    }
  }
  return colours;
}

/**
 * 1 for each vertex of the skin: hair, lashes and teeth by their materials, and eyes and tongue, whose motions are their own,
 * are none.
 */
export function skinVertices(
  mesh: Pick<DrawableMesh, 'vertexCount' | 'indices' | 'groups' | 'rigid'>,
  materials: readonly Pick<RigMaterial, 'name' | 'roughness' | 'alpha_mode'>[],
): Uint8Array {
  const skin = new Uint8Array(mesh.vertexCount);
  for (const { start, count, material } of mesh.groups) {
    const facts = materials[material];
    if (facts && !isSkinLike(facts.name, facts.roughness, facts.alpha_mode !== 'opaque')) continue;
    for (let i = start; i < start + count; i += 1) {
      const vertex = mesh.indices[i]!;
      skin[vertex] = followsPoints(mesh.rigid[vertex]!) ? 1 : 0;
    }
  }
  return skin;
}

/** How much of a face follows points by weights. */
export interface Coverage {
  /** Vertices of the skin. */
  vertices: number;
  /** Of these: with no weight, and with less than `littleWeight` in all. */
  none: number;
  little: number;
}

/**
 * Four bytes per vertex for the shader. Of a heat map: the colour of what is not reached, and the weight. Of the others:
 * a colour, and 255 where it is hatched.
 */
export type VertexColours = Uint8Array;

/** The weights of these points added up. */
export function paintHeat(rows: InfluenceRows, points: ReadonlySet<number>, out: VertexColours): void {
  for (let v = 0; v < rows.vertexCount; v += 1) {
    let sum = 0;
    for (let k = rows.rowOffsets[v]!; k < rows.rowOffsets[v + 1]!; k += 1)
      if (points.has(rows.rowPoints[k]!)) sum += rows.rowWeights[k]!;
    put(out, v, restColour, Math.round(Math.min(sum, 1) * 255));
  }
}

/** Each point in its colour (a number of `regionColours`), as strong as its weight. */
export function paintRegions(rows: InfluenceRows, colourOf: ReadonlyMap<number, number>, out: VertexColours): void {
  const mixed: [number, number, number] = [0, 0, 0];
  for (let v = 0; v < rows.vertexCount; v += 1) {
    mixed[0] = restColour[0];
    mixed[1] = restColour[1];
    mixed[2] = restColour[2];
    for (let k = rows.rowOffsets[v]!; k < rows.rowOffsets[v + 1]!; k += 1) {
      const colour = colourOf.get(rows.rowPoints[k]!);
      if (colour === undefined) continue;
      for (let i = 0 as 0 | 1 | 2; i < 3; i += 1)
        mixed[i]! += rows.rowWeights[k]! * (regionColours[colour]![i]! - restColour[i]!);
    }
    put(out, v, mixed, 0);
  }
}

/** Each vertex in the colour of its strongest point. */
export function paintStrongest(strongest: Int16Array, colours: Uint8Array, out: VertexColours): void {
  strongest.forEach((point, v) => put(out, v, point < 0 ? restColour : regionColours[colours[point]!]!, 0));
}

/** Vertices that follow no point, hatched, and those that follow points a little, in colours of warning. */
export function paintUncovered(rows: InfluenceRows, skin: Uint8Array, out: VertexColours): Coverage {
  const coverage = { vertices: 0, none: 0, little: 0 };
  for (let v = 0; v < rows.vertexCount; v += 1) {
    if (skin[v] === 0) {
      put(out, v, restColour, 0);
      continue;
    }
    let sum = 0;
    for (let k = rows.rowOffsets[v]!; k < rows.rowOffsets[v + 1]!; k += 1) sum += rows.rowWeights[k]!;
    coverage.vertices += 1;
    if (sum === 0) {
      coverage.none += 1;
      put(out, v, uncoveredColour, 255);
    } else if (sum < littleWeight) {
      coverage.little += 1;
      put(out, v, littleColour, 0);
    } else {
      put(out, v, coveredColour, 0);
    }
  }
  return coverage;
}

function put(out: VertexColours, v: number, colour: Rgb, last: number): void {
  out[v * 4] = colour[0];
  out[v * 4 + 1] = colour[1];
  out[v * 4 + 2] = colour[2];
  out[v * 4 + 3] = last;
}

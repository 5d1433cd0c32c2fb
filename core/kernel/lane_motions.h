/* Internal: the motions of a vertex after Eq. 7, one vertex per lane (see lanes.h): rigid parts, irises, lids and the
 * head's rotation. semblante_deform uses them with one lane, the loops over groups with as many as a register has. */
#ifndef SEMBLANTE_KERNEL_LANE_MOTIONS_H
#define SEMBLANTE_KERNEL_LANE_MOTIONS_H

#include <stddef.h>

#include "core/kernel/lanes.h"
#include "core/kernel/local_motion.h"

/* The rigid motion m of all lanes. `slides`: it may have a translation. */
LANE_FUNCTION void move_rigidly(const semblante_rigid_motion* m, int slides, reg p[3]) {
  const reg d[3] = {p[0] - m->pivot[0], p[1] - m->pivot[1], p[2] - m->pivot[2]};
  for (int i = 0; i < 3; ++i) {
    const reg turned = m->change[i][0] * d[0] + m->change[i][1] * d[1] + m->change[i][2] * d[2];
    p[i] += slides ? turned + m->translation[i] : turned;
  }
}

LANE_FUNCTION void choose_point(mask where, const reg yes[3], reg p[3]) {
  for (int i = 0; i < 3; ++i) {
    p[i] = choose(where, yes[i], p[i]);
  }
}

/* The head's motion where a vertex has only `turn` 255ths of it, 1 to 254: the rotation between none and q, by
 * normalized linear interpolation along the shorter arc. The quaternion keeps its length, by whose square the matrix is
 * divided instead: one quotient in place of a square root and four quotients. */
LANE_FUNCTION void turn_partly(const float q[4], const float pivot[3], ints turn, reg p[3]) {
  const reg share = as_reals(turn) * (1.0F / (float)SEMBLANTE_TURN_FULL);
  const reg side = q[3] < 0.0F ? -share : share;
  const reg x = side * q[0];
  const reg y = side * q[1];
  const reg z = side * q[2];
  const reg w = (1.0F - share) + side * q[3];
  const reg xx = x * x;
  const reg yy = y * y;
  const reg zz = z * z;
  /* The square of the length is at least 1/2. */
  const reg twice = 2.0F / (xx + yy + zz + w * w);
  const reg change[3][3] = {{-(yy + zz), x * y - w * z, x * z + w * y},
                            {x * y + w * z, -(xx + zz), y * z - w * x},
                            {x * z - w * y, y * z + w * x, -(xx + yy)}};
  const reg d[3] = {p[0] - pivot[0], p[1] - pivot[1], p[2] - pivot[2]};
  for (int i = 0; i < 3; ++i) {
    p[i] += twice * (change[i][0] * d[0] + change[i][1] * d[1] + change[i][2] * d[2]);
  }
}

/* Changes the size of a pupil: adds to p the displacement of the rest position along its radius and along the curved
 * surface. */
LANE_FUNCTION void move_iris(const semblante_iris* iris, const float pivot[3], float growth, const reg rest[3],
                             reg p[3]) {
  if (growth == 0.0F || iris->pupil_radius <= 0.0F) {
    return;
  }
  const reg d[3] = {rest[0] - pivot[0], rest[1] - pivot[1], rest[2] - pivot[2]};
  const reg along = dot_with(d, iris->axis);
  const reg out[3] = {d[0] - along * iris->axis[0], d[1] - along * iris->axis[1], d[2] - along * iris->axis[2]};
  const reg r = square_root(dot_product(out, out));
  /* The vertex moves outwards by stretch * r. */
  const reg ring = growth * (iris->iris_radius - r) / ((iris->iris_radius - iris->pupil_radius) * r);
  const reg stretch = choose(less(r, all_lanes(iris->pupil_radius)), all_lanes(growth / iris->pupil_radius),
                             choose(less(r, all_lanes(iris->iris_radius)), ring, all_lanes(0.0F)));
  /* bend * ((r + stretch r)^2 - r^2) */
  const reg sink = iris->bend * (r * r) * (stretch * (2.0F + stretch));
  for (int i = 0; i < 3; ++i) {
    p[i] += stretch * out[i] + sink * iris->axis[i];
  }
}

/* The radius of the ball in the direction of d, a vector of length `distance` from its centre. */
LANE_FUNCTION reg radius_towards(const semblante_lids* lids, const float pole[3], const reg d[3], reg distance) {
  const float last = (float)(SEMBLANTE_BALL_PLACES - 1);
  const reg at = square_root(1.0F - within(dot_with(d, pole) / distance, 0.0F, 1.0F)) * last;
  /* Not a number counts as the equator, so that the look-up stays within the table. */
  const ints k = whole(choose(less(at, all_lanes(last)), at, all_lanes(last - 1.0F)));
  reg here;
  reg next;
  look_up_two(lids->ball, k, &here, &next);
  return here + (at - as_reals(k)) * (next - here);
}

/* The distance of a vertex from the ball on the neutral face, negative inside; not a number at the pivot itself. */
LANE_FUNCTION reg clearance_at_rest(const semblante_lids* lids, const float pivot[3], const reg rest[3]) {
  const reg r[3] = {rest[0] - pivot[0], rest[1] - pivot[1], rest[2] - pivot[2]};
  const reg at_rest = square_root(dot_product(r, r));
  return choose(less(all_lanes(0.0F), at_rest), at_rest - radius_towards(lids, lids->gaze, r, at_rest),
                all_lanes(__builtin_nanf("")));
}

/* The lanes of `where` that may be nearer to the ball than their clearance. */
LANE_FUNCTION mask near_ball(const semblante_lid_roll* roll, mask where, const reg p[3]) {
  const reg d[3] = {p[0] - roll->ball_center[0], p[1] - roll->ball_center[1], p[2] - roll->ball_center[2]};
  return where & less(dot_product(d, d), all_lanes(roll->square_reach));
}

/* Moves p away from the ball to the vertex's clearance, in the lanes `where` of near_ball. `way`: by which its height
 * changes. `known`: its clearance_at_rest, or null. */
LANE_FUNCTION void clear_ball(const semblante_lid_roll* roll, mask where, reg way, const reg rest[3], const reg* known,
                              reg p[3]) {
  const reg zero = all_lanes(0.0F);
  const semblante_lids* const lids = roll->lids;
  const reg risen = p[1] - rest[1];
  const reg height = within(choose(less(risen, zero), -risen, risen), 0.0F, lids->opening);
  const reg wanted = roll->clearance + lids->lift * height;
  const reg d[3] = {p[0] - roll->ball_center[0], p[1] - roll->ball_center[1], p[2] - roll->ball_center[2]};
  const reg own = known != NULL ? *known : clearance_at_rest(lids, roll->pivot, rest);
  const reg distance = square_root(dot_product(d, d));
  where &= less(zero, distance);
  const reg gained = choose(less(way, zero), -way, way) * roll->gain + roll->gained;
  const reg grown = own + within(gained, 0.0F, 1.0F) * (wanted - own);
  /* What lies deeper on the neutral face is the inside of a lid: hidden. */
  const reg clearance =
      choose(at_least(own, wanted), wanted, choose(less(all_lanes(-roll->clearance), own), grown, own));
  const reg least = radius_towards(lids, roll->pole, d, distance) + clearance;
  where &= less(distance, least); /* false at the pivot */
  /* Forwards, so that the height stays that of Eq. 7; at the border of the ball away from its centre. */
  const reg square = least * least - d[0] * d[0] - d[1] * d[1];
  const mask forwards = less(zero, d[2]) & less(0.25F * least * least, square);
  const reg share = (least - distance) / distance;
  const reg cleared[3] = {choose(forwards, p[0], p[0] + d[0] * share), choose(forwards, p[1], p[1] + d[1] * share),
                          p[2] + choose(forwards, square_root(square) - d[2], d[2] * share)};
  choose_point(where, cleared, p);
}

/* Moves the lanes `where` with the weights `upper` and `lower` of the two points of their lids. `p`: on input the
 * position by Eq. 7, on output with the height that the closures give it, on its circle round the eye. *way: by which
 * its height changes. The result: the lanes that clear_ball is still to move. */
LANE_FUNCTION mask roll_lids(const semblante_lid_roll* roll, mask where, reg upper, reg lower, const reg rest[3],
                             reg p[3], reg* way) {
  const mask none = less(all_lanes(0.0F), all_lanes(0.0F));
  *way = all_lanes(0.0F);
  if (!(roll->lids->opening > 0.0F)) {
    return none;
  }
  if (!roll->moves) { /* what is at rest stays bit for bit */
    where &= differs(p[0], rest[0]) | differs(p[1], rest[1]) | differs(p[2], rest[2]);
    if (!any(where)) {
      return none;
    }
  }
  reg q[3];
  for (int i = 0; i < 3; ++i) {
    q[i] = p[i] - (upper * roll->upper[i] + lower * roll->lower[i]);
  }
  *way = roll->lids->opening * (lower * roll->closure[1] - upper * roll->closure[0]);
  const mask rises = where & differs(*way, all_lanes(0.0F));
  if (any(rises)) {
    const reg y = q[1] - roll->pivot[1];
    const reg z = q[2] - roll->pivot[2];
    const reg least = (SEMBLANTE_LID_NEAREST * SEMBLANTE_LID_NEAREST) * (y * y + z * z); /* depth, squared */
    const reg square = y * y + z * z - (y + *way) * (y + *way);
    const reg slid = q[2] + (square_root(choose(less(least, square), square, least)) - z);
    /* What lies behind the axis does not slide. */
    q[2] = choose(rises & less(all_lanes(0.0F), z) & less(least, z * z), slid, q[2]);
  }
  q[1] += *way;
  choose_point(where, q, p);
  return roll->clearance > 0.0F ? near_ball(roll, where, p) : none;
}

#endif

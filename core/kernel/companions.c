/* Feature points that follow others: a chin follows the jaw, the fold of a lid its edge. */
#include "core/kernel/companions.h"

static int moves(const float d[3]) { return d[0] != 0.0F || d[1] != 0.0F || d[2] != 0.0F; }

/* One entry, with the displacements `led` of the leaders. */
static void follow(const semblante_rig* rig, const semblante_companion* c, const float* set, const uint8_t* own,
                   const float* led, float* fp) {
  const float share = c->is_choice ? rig->lip_share * c->share : c->share;
  const uint32_t point = c->point * 3U;
  const uint32_t leader = c->leader * 3U;
  /* A set that moves the point itself is complete; then the point follows only what low-level FAPs add. */
  const int is_in_set = moves(&set[point]);
  for (uint32_t i = 0; i < 3; ++i) {
    if ((own[c->point] >> i & 1U) == 0) {
      fp[point + i] += share * (is_in_set ? led[leader + i] - set[leader + i] : led[leader + i]);
    }
  }
}

void semblante_move_companions(const semblante_rig* rig, const float* set, const uint8_t* own, float* fp) {
  /* A point that leads others follows first, and leads with its whole displacement: the cheek follows the outer corner
   * of the lips also where the outer corner follows the inner one. Within a pass the order of entries has no effect. */
  uint8_t leads[SEMBLANTE_FP_COUNT] = {0};
  for (uint32_t k = 0; k < rig->companion_count; ++k) {
    if (!rig->companion[k].is_choice) {
      leads[rig->companion[k].leader] = 1;
    }
  }
  for (int pass = 0; pass < 2; ++pass) {
    float led[SEMBLANTE_FP_COUNT * 3];
    for (uint32_t i = 0; i < SEMBLANTE_FP_COUNT * 3; ++i) {
      led[i] = fp[i];
    }
    for (uint32_t k = 0; k < rig->companion_count; ++k) {
      const semblante_companion* const c = &rig->companion[k];
      const int is_first = leads[c->point] && !c->is_choice;
      if (is_first == (pass == 0)) {
        follow(rig, c, set, own, led, fp);
      }
    }
  }
}

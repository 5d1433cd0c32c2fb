/* Generated from core/tables/data by semblante-codegen-tables; change the data, not this. */
/* clang-format off */
#ifndef SEMBLANTE_MPEG4_TABLES_H
#define SEMBLANTE_MPEG4_TABLES_H

#include <stdint.h>

#define SEMBLANTE_FAP_HIGH_LEVEL 0 /* a displacement set: nothing of one point alone */
#define SEMBLANTE_FAP_TRANSLATION 1
#define SEMBLANTE_FAP_ROTATION 2
#define SEMBLANTE_FAP_PUPIL 3 /* the diameter of a pupil changes */
#define SEMBLANTE_FAP_ROLL 4  /* the borders of the tongue turn up */

#define SEMBLANTE_FP_LEFT_PUPIL 18
#define SEMBLANTE_FP_RIGHT_PUPIL 19
/* The point of the right eye is the next one. */
#define SEMBLANTE_FP_LEFT_UPPER_LID 14
#define SEMBLANTE_FP_LEFT_LOWER_LID 16

/* displacement (or angle) = sign * value * unit along (or about) the axis */
typedef struct semblante_fap_entry {
  uint8_t kind; /* SEMBLANTE_FAP_* */
  uint8_t fp;   /* dense index of the feature point */
  uint8_t axis; /* 0 x, 1 y, 2 z; 0 for pupils and roll, which have none */
  int8_t sign;
  uint8_t unit; /* 0 IRISD, 1 ES, 2 ENS, 3 MNS, 4 MW, 5 AU */
} semblante_fap_entry;

/* By FAP number; entry 0 is not a FAP. */
static const semblante_fap_entry semblante_fap_table[69] = {
    {SEMBLANTE_FAP_HIGH_LEVEL, 0, 0, 0, 0},
    {SEMBLANTE_FAP_HIGH_LEVEL, 0, 0, 0, 0}, /* 1 viseme */
    {SEMBLANTE_FAP_HIGH_LEVEL, 0, 0, 0, 0}, /* 2 expression */
    {SEMBLANTE_FAP_TRANSLATION, 0, 1, -1, 3}, /* 3 open_jaw */
    {SEMBLANTE_FAP_TRANSLATION, 1, 1, -1, 3}, /* 4 lower_t_midlip */
    {SEMBLANTE_FAP_TRANSLATION, 2, 1, 1, 3}, /* 5 raise_b_midlip */
    {SEMBLANTE_FAP_TRANSLATION, 3, 0, 1, 4}, /* 6 stretch_l_cornerlip */
    {SEMBLANTE_FAP_TRANSLATION, 4, 0, -1, 4}, /* 7 stretch_r_cornerlip */
    {SEMBLANTE_FAP_TRANSLATION, 5, 1, -1, 3}, /* 8 lower_t_lip_lm */
    {SEMBLANTE_FAP_TRANSLATION, 6, 1, -1, 3}, /* 9 lower_t_lip_rm */
    {SEMBLANTE_FAP_TRANSLATION, 7, 1, 1, 3}, /* 10 raise_b_lip_lm */
    {SEMBLANTE_FAP_TRANSLATION, 8, 1, 1, 3}, /* 11 raise_b_lip_rm */
    {SEMBLANTE_FAP_TRANSLATION, 3, 1, 1, 3}, /* 12 raise_l_cornerlip */
    {SEMBLANTE_FAP_TRANSLATION, 4, 1, 1, 3}, /* 13 raise_r_cornerlip */
    {SEMBLANTE_FAP_TRANSLATION, 0, 2, 1, 3}, /* 14 thrust_jaw */
    {SEMBLANTE_FAP_TRANSLATION, 0, 0, -1, 4}, /* 15 shift_jaw */
    {SEMBLANTE_FAP_TRANSLATION, 2, 2, 1, 3}, /* 16 push_b_lip */
    {SEMBLANTE_FAP_TRANSLATION, 1, 2, 1, 3}, /* 17 push_t_lip */
    {SEMBLANTE_FAP_TRANSLATION, 9, 1, 1, 3}, /* 18 depress_chin */
    {SEMBLANTE_FAP_TRANSLATION, 14, 1, -1, 0}, /* 19 close_t_l_eyelid */
    {SEMBLANTE_FAP_TRANSLATION, 15, 1, -1, 0}, /* 20 close_t_r_eyelid */
    {SEMBLANTE_FAP_TRANSLATION, 16, 1, 1, 0}, /* 21 close_b_l_eyelid */
    {SEMBLANTE_FAP_TRANSLATION, 17, 1, 1, 0}, /* 22 close_b_r_eyelid */
    {SEMBLANTE_FAP_ROTATION, 18, 1, 1, 5}, /* 23 yaw_l_eyeball */
    {SEMBLANTE_FAP_ROTATION, 19, 1, 1, 5}, /* 24 yaw_r_eyeball */
    {SEMBLANTE_FAP_ROTATION, 18, 0, 1, 5}, /* 25 pitch_l_eyeball */
    {SEMBLANTE_FAP_ROTATION, 19, 0, 1, 5}, /* 26 pitch_r_eyeball */
    {SEMBLANTE_FAP_TRANSLATION, 18, 2, 1, 1}, /* 27 thrust_l_eyeball */
    {SEMBLANTE_FAP_TRANSLATION, 19, 2, 1, 1}, /* 28 thrust_r_eyeball */
    {SEMBLANTE_FAP_PUPIL, 18, 0, 1, 0}, /* 29 dilate_l_pupil */
    {SEMBLANTE_FAP_PUPIL, 19, 0, 1, 0}, /* 30 dilate_r_pupil */
    {SEMBLANTE_FAP_TRANSLATION, 28, 1, 1, 2}, /* 31 raise_l_i_eyebrow */
    {SEMBLANTE_FAP_TRANSLATION, 29, 1, 1, 2}, /* 32 raise_r_i_eyebrow */
    {SEMBLANTE_FAP_TRANSLATION, 30, 1, 1, 2}, /* 33 raise_l_m_eyebrow */
    {SEMBLANTE_FAP_TRANSLATION, 31, 1, 1, 2}, /* 34 raise_r_m_eyebrow */
    {SEMBLANTE_FAP_TRANSLATION, 32, 1, 1, 2}, /* 35 raise_l_o_eyebrow */
    {SEMBLANTE_FAP_TRANSLATION, 33, 1, 1, 2}, /* 36 raise_r_o_eyebrow */
    {SEMBLANTE_FAP_TRANSLATION, 28, 0, -1, 1}, /* 37 squeeze_l_eyebrow */
    {SEMBLANTE_FAP_TRANSLATION, 29, 0, 1, 1}, /* 38 squeeze_r_eyebrow */
    {SEMBLANTE_FAP_TRANSLATION, 34, 0, 1, 1}, /* 39 puff_l_cheek */
    {SEMBLANTE_FAP_TRANSLATION, 35, 0, -1, 1}, /* 40 puff_r_cheek */
    {SEMBLANTE_FAP_TRANSLATION, 36, 1, 1, 2}, /* 41 lift_l_cheek */
    {SEMBLANTE_FAP_TRANSLATION, 37, 1, 1, 2}, /* 42 lift_r_cheek */
    {SEMBLANTE_FAP_TRANSLATION, 38, 0, -1, 4}, /* 43 shift_tongue_tip */
    {SEMBLANTE_FAP_TRANSLATION, 38, 1, 1, 3}, /* 44 raise_tongue_tip */
    {SEMBLANTE_FAP_TRANSLATION, 38, 2, 1, 4}, /* 45 thrust_tongue_tip */
    {SEMBLANTE_FAP_TRANSLATION, 39, 1, 1, 3}, /* 46 raise_tongue */
    {SEMBLANTE_FAP_ROLL, 40, 0, 1, 5}, /* 47 tongue_roll */
    {SEMBLANTE_FAP_ROTATION, 42, 0, 1, 5}, /* 48 head_pitch */
    {SEMBLANTE_FAP_ROTATION, 42, 1, 1, 5}, /* 49 head_yaw */
    {SEMBLANTE_FAP_ROTATION, 42, 2, 1, 5}, /* 50 head_roll */
    {SEMBLANTE_FAP_TRANSLATION, 43, 1, -1, 3}, /* 51 lower_t_midlip_o */
    {SEMBLANTE_FAP_TRANSLATION, 44, 1, 1, 3}, /* 52 raise_b_midlip_o */
    {SEMBLANTE_FAP_TRANSLATION, 45, 0, 1, 4}, /* 53 stretch_l_cornerlip_o */
    {SEMBLANTE_FAP_TRANSLATION, 46, 0, -1, 4}, /* 54 stretch_r_cornerlip_o */
    {SEMBLANTE_FAP_TRANSLATION, 47, 1, -1, 3}, /* 55 lower_t_lip_lm_o */
    {SEMBLANTE_FAP_TRANSLATION, 48, 1, -1, 3}, /* 56 lower_t_lip_rm_o */
    {SEMBLANTE_FAP_TRANSLATION, 49, 1, 1, 3}, /* 57 raise_b_lip_lm_o */
    {SEMBLANTE_FAP_TRANSLATION, 50, 1, 1, 3}, /* 58 raise_b_lip_rm_o */
    {SEMBLANTE_FAP_TRANSLATION, 45, 1, 1, 3}, /* 59 raise_l_cornerlip_o */
    {SEMBLANTE_FAP_TRANSLATION, 46, 1, 1, 3}, /* 60 raise_r_cornerlip_o */
    {SEMBLANTE_FAP_TRANSLATION, 53, 0, 1, 2}, /* 61 stretch_l_nose */
    {SEMBLANTE_FAP_TRANSLATION, 54, 0, -1, 2}, /* 62 stretch_r_nose */
    {SEMBLANTE_FAP_TRANSLATION, 55, 1, 1, 2}, /* 63 raise_nose */
    {SEMBLANTE_FAP_TRANSLATION, 55, 0, -1, 2}, /* 64 bend_nose */
    {SEMBLANTE_FAP_TRANSLATION, 68, 1, 1, 2}, /* 65 raise_l_ear */
    {SEMBLANTE_FAP_TRANSLATION, 69, 1, 1, 2}, /* 66 raise_r_ear */
    {SEMBLANTE_FAP_TRANSLATION, 70, 0, 1, 2}, /* 67 pull_l_ear */
    {SEMBLANTE_FAP_TRANSLATION, 71, 0, -1, 2}, /* 68 pull_r_ear */
};

#endif

#include "core/kernel/local_motion.h"

void semblante_prepare_local(const semblante_pose* pose, semblante_local_motions* motions) {
  for (int eye = 0; eye < 2; ++eye) {
    motions->eye[eye] =
        semblante_rigid_motion_of(pose->eye_rotation[eye], pose->eye_pivot[eye], pose->eye_translation[eye]);
  }
}

void semblante_move_local(const semblante_local_motions* motions, uint8_t rigid, const float rest[3], float p[3]) {
  (void)rest;
  semblante_move(&motions->eye[rigid - SEMBLANTE_RIGID_LEFT_EYE], p);
}

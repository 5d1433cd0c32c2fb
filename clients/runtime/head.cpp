#include "clients/runtime/head.h"

#include <cmath>
#include <cstring>

#include "clients/runtime/border.h"

namespace semblante::runtime {

const semblante_pose& EvaluatedPoses::of(const semblante_rig& rig, const semblante_frame& frame) {
  Entry* oldest = &entries_[0];
  for (Entry& entry : entries_) {
    // A frame that differs in its padding or the sign of a zero alone is evaluated again, which is right too.
    if (entry.number != 0 && entry.viseme_share == rig.viseme_share &&
        std::memcmp(&entry.frame, &frame, sizeof(frame)) == 0) {  // NOLINT(bugprone-suspicious-memory-comparison)
      entry.used = ++uses_;
      return entry.pose;
    }
    if (entry.used < oldest->used) oldest = &entry;
  }
  oldest->number = ++evaluations_;
  oldest->used = ++uses_;
  oldest->viseme_share = rig.viseme_share;
  oldest->frame = frame;
  semblante_evaluate(&rig, &frame, &oldest->pose);
  return oldest->pose;
}

std::uint64_t EvaluatedPoses::number_of(const semblante_pose& pose) const {
  for (const Entry& entry : entries_) {
    if (&entry.pose == &pose) return entry.number;
  }
  return 0;
}

}  // namespace semblante::runtime

using namespace semblante::runtime;

extern "C" {

uint32_t semblante_head_vertex_count(const semblante_head* head) {
  return head == nullptr ? 0 : head->face.vertex_count;
}

const semblante_rig* semblante_head_rig(const semblante_head* head) { return head == nullptr ? nullptr : &head->rig; }

const semblante_face* semblante_head_face(const semblante_head* head) {
  return head == nullptr ? nullptr : &head->face;
}

const uint32_t* semblante_head_triangles(const semblante_head* head, uint32_t* triangle_count) {
  const bool has_any = head != nullptr && !head->corners.empty();
  if (triangle_count != nullptr) *triangle_count = has_any ? head->triangles.triangle_count : 0;
  return has_any ? head->corners.data() : nullptr;
}

const float* semblante_head_uvs(const semblante_head* head) {
  return head == nullptr || head->uvs.empty() ? nullptr : head->uvs.data();
}

const uint8_t* semblante_head_colors(const semblante_head* head) {
  return head == nullptr || head->colors.empty() ? nullptr : head->colors.data();
}

const semblante_pose* semblante_head_pose(const semblante_head* head) {
  return head == nullptr ? nullptr : &head->pose;
}

semblante_result semblante_head_set_viseme_share(semblante_head* head, float viseme_share) {
  if (head == nullptr || !(viseme_share >= 0.0F && viseme_share <= 1.0F)) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  head->rig.viseme_share = viseme_share;
  return SEMBLANTE_OK;
}

semblante_result semblante_head_set_frame(semblante_head* head, const semblante_frame* frame) {
  if (head == nullptr || frame == nullptr || !is_finite(*frame)) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  head->shown = {};
  semblante_evaluate(&head->rig, frame, &head->pose);
  return SEMBLANTE_OK;
}

semblante_result semblante_head_set_interpolated(semblante_head* head, const semblante_frame* from,
                                                 const semblante_frame* to, float t) {
  if (head == nullptr || from == nullptr || to == nullptr || !std::isfinite(t) || !is_finite(*from) ||
      !is_finite(*to)) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  head->shown = {};
  semblante_pose first;
  semblante_pose second;
  semblante_evaluate(&head->rig, from, &first);
  semblante_evaluate(&head->rig, to, &second);
  semblante_interpolate(&first, &second, t, &head->pose);
  return SEMBLANTE_OK;
}

semblante_result semblante_head_get_pose(const semblante_head* head, semblante_pose* pose) {
  if (head == nullptr || pose == nullptr) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  *pose = head->pose;
  return SEMBLANTE_OK;
}

semblante_result semblante_head_set_pose(semblante_head* head, const semblante_pose* pose) {
  if (head == nullptr || pose == nullptr || !is_finite(*pose)) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  head->shown = {};
  head->pose = *pose;
  return SEMBLANTE_OK;
}

semblante_result semblante_head_positions(const semblante_head* head, float* positions, size_t capacity) {
  if (head == nullptr || positions == nullptr || head->prepared == nullptr) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  if (capacity < std::size_t{head->face.vertex_count} * 3) return SEMBLANTE_BUFFER_TOO_SMALL;
  semblante_deform_prepared(head->prepared, &head->pose, positions);
  return SEMBLANTE_OK;
}

semblante_result semblante_head_update_positions(const semblante_head* head, const semblante_pose* before,
                                                 float* positions, size_t capacity) {
  if (head == nullptr || before == nullptr || positions == nullptr || head->prepared == nullptr ||
      !is_finite(*before)) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  if (capacity < std::size_t{head->face.vertex_count} * 3) return SEMBLANTE_BUFFER_TOO_SMALL;
  semblante_deform_changed(head->prepared, before, &head->pose, positions);
  return SEMBLANTE_OK;
}

semblante_result semblante_head_normals(const semblante_head* head, const float* positions, float* normals,
                                        size_t capacity) {
  if (head == nullptr || positions == nullptr || normals == nullptr || head->joined.empty()) {
    return SEMBLANTE_INVALID_ARGUMENT;
  }
  if (capacity < std::size_t{head->face.vertex_count} * 3) return SEMBLANTE_BUFFER_TOO_SMALL;
  semblante_normals(&head->triangles, positions, normals);
  semblante_turn_normals(head->face.vertex_count, head->own_normals.data(), head->rest_normals.data(), normals);
  return SEMBLANTE_OK;
}

}  // extern "C"

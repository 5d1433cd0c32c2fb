#include "protocol/clips/clip.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "protocol/clips/clip_tracks.h"
#include "protocol/clips/face_skin.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/rig_kernel.h"
#include "protocol/package/gltf_builder.h"
#include "protocol/package/quantization.h"

namespace semblante {
namespace {

// Effort limit of measuring a clip's error: vertices times frames, but at least this many frames.
constexpr std::size_t measured_vertices = 10'000'000;
constexpr std::size_t least_measured = 64;

/// The kernel on a package.
class KernelFace {
 public:
  KernelFace(const PackedFace& face, std::optional<float> viseme_share)
      : kernel_(to_kernel_rig(face.rig)), rig_(kernel_.view()) {
    if (viseme_share) rig_.viseme_share = *viseme_share;
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    face_.vertex_count = face.table.vertex_count;
    face_.rest = &face.mesh.positions.front().x;
    face_.row_offsets = face.table.rows.offsets.data();
    face_.row_points = reinterpret_cast<const std::uint8_t*>(face.table.rows.points.data());
    face_.row_weights = face.table.rows.weights.data();
    face_.rigid = face.table.rigid.data();
    face_.turn = face.table.turn.empty() ? nullptr : face.table.turn.data();
  }

  [[nodiscard]] semblante_pose pose(const FaceValues& values) const {
    const semblante_frame frame = to_kernel_frame(values);
    semblante_pose out{};
    semblante_evaluate(&rig_, &frame, &out);
    return out;
  }

  void deform(const semblante_pose& pose, std::vector<glm::vec3>& positions) const {
    semblante_deform(&face_, &pose, &positions.front().x);
  }

 private:
  KernelRig kernel_;
  semblante_rig rig_;
  semblante_face face_{};
};

double quantum_of(const PackedFace& face) {
  const float side = longest_side(face.rig.bounds_min, face.rig.bounds_max);
  return static_cast<double>(side) / ((1 << position_bits(side, face.rig.fapu)) - 1);
}

/// Distance of the farthest vertex from `pivot` among those for which `takes_part` is true.
template <class TakesPart>
double reach(const PackedFace& face, glm::vec3 pivot, TakesPart takes_part) {
  float farthest = 0.0F;
  for (std::size_t v = 0; v < face.mesh.positions.size(); ++v) {
    if (takes_part(face.table.rigid[v])) farthest = std::max(farthest, glm::distance(face.mesh.positions[v], pivot));
  }
  return farthest;
}

double largest_distance(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
  float largest = 0.0F;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, glm::distance(a[i], b[i]));
  return largest;
}

/// The tracks of one joint.
struct JointTracks {
  VectorTrack translation;
  TurnTrack rotation;
  VectorTrack scale;
};

/// Makes tracks with the greatest shift, turn (radians) and growth of each joint within half a quantum of `face`.
std::vector<JointTracks> make_tracks(const PackedFace& face, const FaceSkin& skin, double tolerance) {
  std::vector<JointTracks> tracks;
  for (const FaceJoint& joint : skin.joints) {
    double radius = 0.0;
    if (joint.kind == FaceJoint::Kind::head) radius = reach(face, joint.place, [](std::uint8_t) { return true; });
    if (joint.kind == FaceJoint::Kind::eye) {
      radius = reach(face, joint.place, [&](std::uint8_t rigid) {
        return is_eye(RigidMotion{rigid}) && is_left_eye(RigidMotion{rigid}) == (joint.index == 0);
      });
    }
    if (joint.kind == FaceJoint::Kind::lid) {
      const auto lids = joint.index < 2 ? RigidMotion::left_lids : RigidMotion::right_lids;
      radius = reach(face, joint.place, [&](std::uint8_t rigid) { return RigidMotion{rigid} == lids; });
    }
    const double rim = joint.kind == FaceJoint::Kind::pupil ? face.rig.irises[joint.index]->pupil_radius : 0.0;
    tracks.push_back({VectorTrack(tolerance), TurnTrack(radius > 0.0 ? tolerance / radius : 0.0),
                      VectorTrack(rim > 0.0 ? tolerance / rim : 0.0)});
  }
  return tracks;
}

/// Builds the tracks of all joints from frames.
class ClipMaker {
 public:
  ClipMaker(const PackedFace& face, const FaceSkin& skin, const ClipOptions& options)
      : face_(face), skin_(skin), kernel_(face, options.viseme_share) {
    figures_.quantum = quantum_of(face);
    figures_.joints = skin.joints.size();
    tracks_ = make_tracks(face, skin, 0.5 * figures_.quantum);
  }

  Status take(std::span<const TimedValues> frames) {
    const std::size_t measured = std::max(least_measured, measured_vertices / face_.mesh.positions.size());
    const std::size_t stride = (frames.size() + measured - 1) / measured;
    std::size_t taken = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (i + 1 < frames.size() && frames[i + 1].time == frames[i].time) continue;
      const semblante_pose pose = kernel_.pose(frames[i].state);
      if (!std::all_of(std::begin(pose.fp), std::end(pose.fp), [](float d) { return std::isfinite(d); }))
        return Error{ErrorCode::not_finite, "/frames/" + std::to_string(i), "moves a point by no finite number"};
      const auto seconds = static_cast<float>((frames[i].time - frames.front().time) / 1000.0);
      push(seconds, pose);
      if (keys() > max_clip_keys) {
        return Error{ErrorCode::too_large, "/frames/" + std::to_string(i),
                     "a clip has at most " + std::to_string(max_clip_keys) + " keys; up to here it has more"};
      }
      if (const float moved = movement(pose); moved >= farthest_moved_) {
        farthest_moved_ = moved;
        farthest_ = pose;
      }
      if (++taken % stride == 0 || i + 1 == frames.size()) measure_farthest();
    }
    frames_ = taken;
    return Unit{};
  }

  /// The channels of the joints that move. The head's rotation is always included, so that the clip is as long as the
  /// frames.
  std::vector<GltfChannel> channels() {
    std::vector<GltfChannel> out;
    const semblante_pose neutral = kernel_.pose({});
    for (std::size_t j = 0; j < tracks_.size(); ++j) {
      const JointTransform rest = joint_transform(skin_, j, neutral);
      JointTracks& track = tracks_[j];
      track.translation.finish();
      track.rotation.finish();
      track.scale.finish();
      add(out, j, GltfChannel::Path::translation, track.translation, rest.translation);
      add(out, j, track.rotation, rest.rotation);
      add(out, j, GltfChannel::Path::scale, track.scale, rest.scale);
    }
    for (const GltfChannel& channel : out) figures_.keys += channel.times.size();
    figures_.channels = out.size();
    figures_.keys_unthinned = out.size() * frames_;
    return out;
  }

  [[nodiscard]] const ClipFigures& figures() const { return figures_; }
  [[nodiscard]] bool tongue_rolled() const { return tongue_rolled_; }

 private:
  void push(float seconds, const semblante_pose& pose) {
    tongue_rolled_ = tongue_rolled_ || pose.tongue_roll != 0.0F;
    for (std::size_t j = 0; j < tracks_.size(); ++j) {
      const JointTransform transform = joint_transform(skin_, j, pose);
      const FaceJoint::Kind kind = skin_.joints[j].kind;
      // A motion that this kind of joint never has, has no track.
      const bool turns = kind == FaceJoint::Kind::head || kind == FaceJoint::Kind::eye || kind == FaceJoint::Kind::lid;
      const bool slides =
          kind == FaceJoint::Kind::eye || kind == FaceJoint::Kind::pupil || kind == FaceJoint::Kind::point;
      if (slides) tracks_[j].translation.push(seconds, transform.translation);
      if (turns) tracks_[j].rotation.push(seconds, transform.rotation);
      if (kind == FaceJoint::Kind::pupil) tracks_[j].scale.push(seconds, transform.scale);
    }
  }

  [[nodiscard]] std::size_t keys() const {
    std::size_t count = 0;
    for (const JointTracks& t : tracks_)
      count += t.translation.times().size() + t.rotation.times().size() + t.scale.times().size();
    return count;
  }

  /// A measure of the face's motion.
  [[nodiscard]] static float movement(const semblante_pose& pose) {
    float sum = pose.pupil_growth[0] * pose.pupil_growth[0] + pose.pupil_growth[1] * pose.pupil_growth[1];
    for (const float d : pose.fp) sum += d * d;
    return sum;
  }

  /// Measures the frame with the most motion of each run of frames, where the error of a skin is greatest.
  void measure_farthest() {
    measure(farthest_);
    farthest_moved_ = -1.0F;
  }

  void measure(const semblante_pose& pose) {
    const std::vector<glm::vec3>& rest = face_.mesh.positions;
    exact_.resize(rest.size());
    skinned_.resize(rest.size());
    semblante_pose flat = pose;
    flat.tongue_roll = 0.0F;
    kernel_.deform(flat, exact_);
    skin_positions(skin_, rest, pose, skin_.influences, skinned_);
    figures_.error = std::max(figures_.error, largest_distance(exact_, skinned_));
    if (skin_.influences > 4) skin_positions(skin_, rest, pose, 4, skinned_);
    figures_.error_first_four = std::max(figures_.error_first_four, largest_distance(exact_, skinned_));
    if (pose.tongue_roll != 0.0F) {
      kernel_.deform(pose, skinned_);
      figures_.error_tongue_roll = std::max(figures_.error_tongue_roll, largest_distance(exact_, skinned_));
    }
    ++figures_.measured_frames;
  }

  static void add(std::vector<GltfChannel>& out, std::size_t joint, GltfChannel::Path path, const VectorTrack& track,
                  const glm::vec3& rest) {
    const auto& values = track.values();
    if (std::all_of(values.begin(), values.end(), [&](const glm::vec3& v) { return v == rest; })) return;
    GltfChannel channel{joint, path, track.times(), {}};
    for (const glm::vec3& v : values) channel.values.insert(channel.values.end(), {v.x, v.y, v.z});
    out.push_back(std::move(channel));
  }

  static void add(std::vector<GltfChannel>& out, std::size_t joint, const TurnTrack& track, const glm::quat& rest) {
    const auto& values = track.values();
    if (values.empty()) return;
    if (joint != 0 && std::all_of(values.begin(), values.end(), [&](const glm::quat& q) { return q == rest; })) return;
    GltfChannel channel{joint, GltfChannel::Path::rotation, track.times(), {}};
    for (const glm::quat& q : values) channel.values.insert(channel.values.end(), {q.x, q.y, q.z, q.w});
    out.push_back(std::move(channel));
  }

  const PackedFace& face_;
  const FaceSkin& skin_;
  KernelFace kernel_;
  std::vector<JointTracks> tracks_;
  ClipFigures figures_;
  std::size_t frames_ = 0;
  bool tongue_rolled_ = false;
  float farthest_moved_ = -1.0F;
  semblante_pose farthest_{};  ///< of the frames since the last measured one
  std::vector<glm::vec3> exact_, skinned_;
};

void add_mesh(const PackedFace& face, const FaceSkin& skin, GltfBuilder& document) {
  using Kind = DracoAttribute::Kind;
  using Type = DracoAttribute::Type;
  for (const Slice& slice : slice_by_material(face.mesh, face.materials.size())) {
    std::vector<SliceAttribute> attributes = geometry_attributes(face.mesh, slice);
    for (std::size_t set = 0; set * 4 < skin.influences; ++set) {
      const std::string number = std::to_string(set);
      const auto at = [&](std::uint32_t v, std::size_t c) { return v * skin.influences + set * 4 + c; };
      attributes.push_back({"JOINTS_" + number, Kind::generic, Type::uint8, 4, 0,
                            gather<std::uint8_t>(slice, 4, [&](auto v, auto c) { return skin.joint[at(v, c)]; })});
      attributes.push_back({"WEIGHTS_" + number, Kind::generic, Type::uint16, 4, 0,
                            gather<std::uint16_t>(slice, 4, [&](auto v, auto c) { return skin.share[at(v, c)]; }),
                            true});
    }
    document.add_plain_primitive(slice, attributes);
  }
  std::vector<GltfJoint> joints;
  for (const FaceJoint& joint : skin.joints) {
    const glm::vec3 from = joint.parent ? skin.joints[*joint.parent].place : glm::vec3(0.0F);
    joints.push_back({joint.name, joint.parent, joint.place - from, joint.facing, inverse_bind(joint)});
  }
  document.set_skin(joints);
}

nlohmann::json extras_of(const ClipFigures& figures, const FaceSkin& skin, const std::vector<std::string>& warnings) {
  nlohmann::json out;
  out["influences"] = skin.influences;
  out["vertices_cut"] = skin.cut_vertices;
  out["joints"] = figures.joints;
  if (figures.channels > 0) {
    out["channels"] = figures.channels;
    out["keys"] = figures.keys;
    out["keys_unthinned"] = figures.keys_unthinned;
  }
  out["quantum"] = figures.quantum;
  out["measured_frames"] = figures.measured_frames;
  out["error"] = figures.error;
  out["error_first_four"] = figures.error_first_four;
  if (figures.error_tongue_roll > 0.0) out["error_tongue_roll"] = figures.error_tongue_roll;
  if (!warnings.empty()) out["warnings"] = warnings;
  return {{"semblante", out}};
}

Status check(std::span<const TimedValues> frames, const ClipOptions& options) {
  if (options.influences < 4 || options.influences > 16 || options.influences % 4 != 0)
    return Error{ErrorCode::invalid_argument, "influences", "are 4, 8, 12 or 16"};
  if (options.viseme_share && !(*options.viseme_share >= 0.0F && *options.viseme_share <= 1.0F))
    return Error{ErrorCode::invalid_argument, "viseme_share", "is 0 to 1"};
  if (frames.size() > max_clip_frames)
    return Error{ErrorCode::too_large, "/frames", "a clip has at most " + std::to_string(max_clip_frames) + " frames"};
  for (std::size_t i = 1; i < frames.size(); ++i) {
    if (frames[i].time < frames[i - 1].time)
      return Error{ErrorCode::out_of_range, "/frames/" + std::to_string(i) + "/time", "falls"};
  }
  if (!frames.empty() && frames.back().time - frames.front().time > max_clip_time)
    return Error{ErrorCode::too_large, "/frames/" + std::to_string(frames.size() - 1) + "/time",
                 "a clip lasts four hours at most"};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto& fap = frames[i].state.fap;
    const auto bad =
        std::find_if(fap.begin(), fap.end(), [](double v) { return !std::isfinite(static_cast<float>(v)); });
    if (bad != fap.end()) {
      return Error{ErrorCode::not_finite, "/frames/" + std::to_string(i) + "/faps/" + std::to_string(bad - fap.begin()),
                   "is no number that single precision can hold"};
    }
  }
  return Unit{};
}

Result<Clip> make(const FaceParts& parts, std::span<const TimedValues> frames, const ClipOptions& options) {
  if (const Status checked = check(frames, options); !checked) return checked.error();
  const auto face = open_package(parts);
  if (!face) return face.error();
  const auto skin = make_face_skin(*face, options.influences);
  if (!skin) return skin.error();
  ClipMaker maker(*face, *skin, options);
  if (const Status taken = maker.take(frames); !taken) return taken.error();

  GltfBuilder document(face->materials, face->images);
  add_mesh(*face, *skin, document);
  if (!frames.empty()) document.add_animation(options.name, maker.channels());
  Clip clip;
  clip.warnings = skin->warnings;
  if (maker.tongue_rolled())
    clip.warnings.emplace_back("FAP 47 (roll of the tongue) is left out: a skin cannot bend it");
  clip.figures = maker.figures();
  document.set_asset_extras(extras_of(clip.figures, *skin, clip.warnings).dump());
  auto glb = document.finish();
  if (!glb) return glb.error();
  clip.glb = std::move(*glb);
  return clip;
}

}  // namespace

Result<Clip> make_clip(const FaceParts& parts, std::span<const TimedValues> frames, const ClipOptions& options) {
  if (frames.empty()) return Error{ErrorCode::empty, "/frames", "there is no frame to make a clip of"};
  return make(parts, frames, options);
}

Result<Clip> make_skinned_face(const FaceParts& parts, const ClipOptions& options) { return make(parts, {}, options); }

}  // namespace semblante

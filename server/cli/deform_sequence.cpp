#include "server/cli/deform_sequence.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "core/expressions/kernel_rig.h"
#include "protocol/cpp/kernel_values.h"
#include "server/cli/command_failure.h"
#include "server/cli/files.h"
#include "server/cli/obj_writer.h"
#include "server/cli/ply_writer.h"

namespace semblante {
namespace {

constexpr std::uint64_t max_meshes = 100'000;

[[noreturn]] void refuse_sequence(const std::string& reason) {
  throw CommandFailure(CommandFailure::bad_input, reason);
}

/// The frames of a sequence by number: each entry's own, rising.
std::vector<std::uint32_t> numbers_of(const FaceSequence& sequence) {
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const double by_time = std::round(sequence.frames[i].time * sequence.rate / 1000.0);
    numbers.push_back(sequence.rate > 0 ? static_cast<std::uint32_t>(by_time) : static_cast<std::uint32_t>(i));
  }
  return numbers;
}

/// Poses at any position between the frames; keeps the two it needs.
class PoseTrack {
 public:
  PoseTrack(const FaceSequence& sequence, const semblante_rig& rig)
      : sequence_(sequence), rig_(rig), numbers_(numbers_of(sequence)) {}

  [[nodiscard]] std::uint32_t last() const { return numbers_.back(); }

  /// `place`: a frame number, or a position between two; rising from call to call.
  semblante_pose at(double place) {
    while (at_ + 1 < numbers_.size() && numbers_[at_ + 1] <= place) ++at_;
    const std::size_t next = std::min(at_ + 1, numbers_.size() - 1);
    if (known_ != at_) {
      from_ = evaluate(at_);
      to_ = evaluate(next);
      known_ = at_;
    }
    if (next == at_ || place <= numbers_[at_]) return from_;
    const double t = (place - numbers_[at_]) / static_cast<double>(numbers_[next] - numbers_[at_]);
    semblante_pose pose{};
    semblante_interpolate(&from_, &to_, static_cast<float>(t), &pose);
    return pose;
  }

 private:
  [[nodiscard]] semblante_pose evaluate(std::size_t i) const {
    const semblante_frame frame = to_kernel_frame(sequence_.frames[i].state);
    semblante_pose pose{};
    semblante_evaluate(&rig_, &frame, &pose);
    return pose;
  }

  const FaceSequence& sequence_;
  const semblante_rig& rig_;
  const std::vector<std::uint32_t> numbers_;
  std::size_t at_ = 0;
  std::size_t known_ = SIZE_MAX;
  semblante_pose from_{}, to_{};
};

}  // namespace

void write_deformed_sequence(const DeformSequence& options, Head& head, const std::string& out) {
  if (out == "-") refuse_sequence("--out: a sequence of meshes needs a folder");
  const FaceSequence sequence = read_faces(options.frames, options.frames_format, options.reading);
  head.remarks.insert(head.remarks.end(), sequence.warnings.begin(), sequence.warnings.end());
  const KernelRig kernel = make_kernel_rig(head.rig);
  const semblante_rig rig = kernel.view();
  PoseTrack track(sequence, rig);
  const std::uint32_t from = options.from.value_or(0);
  const std::uint32_t to = options.to.value_or(track.last());
  if (to > track.last()) refuse_sequence("--to: the last frame is " + std::to_string(track.last()));
  if (from > to) refuse_sequence("--from: is after the last frame to write, " + std::to_string(to));
  const std::uint64_t steps = std::uint64_t{options.between} + 1;
  const std::uint64_t meshes = (to - from) * steps + 1;
  if (meshes > max_meshes) {
    refuse_sequence("deform: that makes " + std::to_string(meshes) + " meshes, at most " + std::to_string(max_meshes) +
                    " are written at once; see --from, --to and --between");
  }
  std::error_code fault;
  std::filesystem::create_directories(out, fault);
  if (fault) refuse_sequence(out + ": cannot be made: " + fault.message());

  std::vector<glm::vec3> deformed(head.model.positions.size());
  const semblante_face rows = make_kernel_face(head.rig, &head.model.positions.front().x);
  for (std::uint64_t i = 0; i < meshes; ++i) {
    const semblante_pose pose = track.at(from + static_cast<double>(i) / static_cast<double>(steps));
    semblante_deform(&rows, &pose, &deformed.front().x);
    char name[32];
    std::snprintf(name, sizeof name, "frame-%05u.%s", static_cast<unsigned>(i), options.format.c_str());
    write_file((std::filesystem::path(out) / name).string(), [&](std::ostream& file) {
      if (options.format == "ply") {
        write_ply(head.model, deformed, file);
      } else {
        write_obj(head.model, deformed, file);
      }
    });
  }
}

}  // namespace semblante

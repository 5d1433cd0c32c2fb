#include "server/cli/face_options.h"

#include <algorithm>
#include <bitset>
#include <charconv>
#include <cmath>
#include <set>

#include <glm/mat3x3.hpp>

#include "core/expressions/contact.h"
#include "core/expressions/kernel_rig.h"
#include "core/expressions/library.h"
#include "core/extract/set_file.h"
#include "core/import/displacements_file.h"
#include "core/parametrize/fapu.h"
#include "core/tables/mpeg4.h"
#include "server/cli/command_failure.h"
#include "server/cli/files.h"

namespace semblante {
namespace {

constexpr std::size_t max_displacements_bytes = std::size_t{1} << 20;

[[noreturn]] void refuse_option(const std::string& option, const std::string& reason) {
  throw CommandFailure(CommandFailure::bad_input, option + ": " + reason);
}

/// Parses a whole text as a number; nullopt otherwise, and for values that are not finite.
template <class Number>
std::optional<Number> parse(std::string_view text) {
  Number value{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return value;
}

const FeaturePoint* find_point(const Rig& rig, FeaturePointId id) {
  const auto found =
      std::find_if(rig.points.begin(), rig.points.end(), [id](const FeaturePoint& p) { return p.id == id; });
  return found == rig.points.end() ? nullptr : &*found;
}

/// Why a FAPU is missing, as reported by the parametrization.
std::string why_missing(const Rig& rig, mpeg4::Unit unit) {
  const auto name = mpeg4::unit_names[static_cast<std::size_t>(unit)];
  for (const std::string& sentence : explain_missing_fapu(rig.fapu, rig.points)) {
    if (sentence.starts_with(std::string(name) + " ")) return sentence.substr(0, sentence.find(';'));
  }
  return std::string(name) + " is not known";
}

/// Refuses a FAP that would have no effect.
void check_fap(const mpeg4::Fap& fap, const std::string& option, const Rig& rig, std::vector<std::string>& warnings) {
  const std::string name = "FAP " + std::to_string(fap.number) + " (" + std::string(fap.name) + ")";
  if (fap.kind == mpeg4::FapKind::scale && !rig.irises[fap.number == 29 ? 0 : 1]) {
    warnings.push_back(option + ": " + name + " does nothing: this head has no iris there that could move");
    return;
  }
  if (fap.kind == mpeg4::FapKind::rotation && fap.axis == mpeg4::no_axis && !rig.tongue) {
    warnings.push_back(option + ": " + name + " does nothing: this head has no tongue that could roll");
    return;
  }
  if (fap.kind != mpeg4::FapKind::translation) return;
  if (!rig.fapu.value[static_cast<std::size_t>(fap.unit)])
    refuse_option(option, name + " needs a unit: " + why_missing(rig, fap.unit));
  // Eyeballs are rotated as parts, not moved by weights.
  const FeaturePointId id(fap.feature_points[0]);
  const bool moves_eyeball = group_of(id) == 3 && (number_of(id) == 5 || number_of(id) == 6);
  const FeaturePoint* const point = find_point(rig, id);
  if (!moves_eyeball && (point == nullptr || !point->vertex)) {
    refuse_option(option, name + " moves feature point " + to_string(id) + ", which is not marked on the surface");
  }
}

void parse_faps(const std::string& text, const Rig& rig, semblante_frame& frame, std::vector<std::string>& warnings) {
  const std::string option = "--faps";
  std::bitset<SEMBLANTE_FAP_COUNT + 1> seen;
  std::string_view rest = text;
  while (true) {
    const std::size_t comma = rest.find(',');
    const std::string item(rest.substr(0, comma));
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos) refuse_option(option, "'" + item + "' must be <number>=<value>");
    const auto number = parse<int>(std::string_view(item).substr(0, equals));
    const auto value = parse<float>(std::string_view(item).substr(equals + 1));
    if (!number) refuse_option(option, "'" + item + "' has no FAP number before the =");
    if (*number == 1 || *number == 2) {
      refuse_option(option,
                    "FAP " + std::to_string(*number) + " is given by " + (*number == 1 ? "--viseme" : "--expression"));
    }
    if (*number < 3 || *number > SEMBLANTE_FAP_COUNT) {
      refuse_option(option, "there is no FAP " + std::to_string(*number) + ", low-level FAPs are 3 to 68");
    }
    if (!value) refuse_option(option, "'" + item + "' has no finite number after the =");
    const auto index = static_cast<std::size_t>(*number);
    if (seen[index]) refuse_option(option, "FAP " + std::to_string(*number) + " is there twice");
    seen.set(index);
    check_fap(mpeg4::fap(index), option, rig, warnings);
    frame.fap[index] = *value;
    if (comma == std::string_view::npos) return;
    rest.remove_prefix(comma + 1);
  }
}

/// Entry of a library by its number or name. `first` is the lowest valid number.
std::uint8_t find_entry(const std::string& option, const std::string& text, std::span<const DisplacementSet> library,
                        std::size_t first) {
  for (std::size_t i = first; i < library.size(); ++i) {
    if (library[i].name == text || parse<std::size_t>(text) == i) return static_cast<std::uint8_t>(i);
  }
  std::string names;
  for (std::size_t i = first; i < library.size(); ++i) names.append(i > first ? ", " : "").append(library[i].name);
  refuse_option(option, "there is no '" + text + "'; it is a number from " + std::to_string(first) + " to " +
                            std::to_string(library.size() - 1) + " or one of " + names);
}

/// Warns of points of a set that cannot move on this head; refuses the set if none can.
void check_set(const std::string& option, const DisplacementSet& set, const Rig& rig,
               std::vector<std::string>& warnings) {
  const ModelDisplacements on_head = to_model_units(set, rig.fapu);
  std::set<FapuUnit> units;
  for (const MissingUnit& missing : on_head.skipped) units.insert(missing.unit);
  std::string unmarked;
  std::size_t moved = 0;
  for (const Displacement& displacement : on_head.displacements) {
    const FeaturePoint* const point = find_point(rig, displacement.point);
    if (point != nullptr && point->vertex) {
      ++moved;
    } else {
      unmarked.append(unmarked.empty() ? "" : ", ").append(to_string(displacement.point));
    }
  }
  for (const FapuUnit unit : units) {
    warnings.push_back(option + ": some points do not move: " + why_missing(rig, static_cast<mpeg4::Unit>(unit)));
  }
  if (!unmarked.empty()) warnings.push_back(option + ": not marked, so not moved: " + unmarked);
  if (moved == 0 && !set.displacements.empty()) {
    refuse_option(option, "'" + std::string(set.name) + "' moves none of the points that are marked");
  }
}

/// Scales one set of a library in place: allows any intensity, while the frame has only 64 steps.
void scale_set(std::vector<float>& table, std::size_t entry, double intensity) {
  constexpr std::size_t row = feature_point_count * 3;
  for (std::size_t i = entry * row; i < (entry + 1) * row; ++i) table[i] *= static_cast<float>(intensity);
}

/// Puts a set into the first slot of its kind's library, at full strength in the frame; no other option may use that
/// slot in the same frame.
void wear_set(const FaceOptions& options, const Rig& rig, KernelRig& kernel, semblante_frame& frame,
              std::vector<std::string>& warnings) {
  const auto json = read_file(options.set, max_displacements_bytes);
  const auto set = parse_displacement_set({reinterpret_cast<const char*>(json.data()), json.size()});
  if (!set) fail(options.set, set.error());
  const bool is_viseme = set->kind == SetKind::viseme;
  if (!(is_viseme ? options.viseme : options.expression).empty()) {
    refuse_option("--set", options.set + " is for " +
                               (is_viseme ? "FAP 1, as --viseme is" : "FAP 2, as --expression is") +
                               "; give one of them");
  }
  check_set("--set", set->view(), rig, warnings);
  constexpr std::size_t slot = 1;
  constexpr std::size_t row = feature_point_count * 3;
  auto& table = is_viseme ? kernel.visemes : kernel.expressions;
  const auto dense = to_dense(on_face(set->view(), rig.fapu, rig.points, rig.lip_gaps).displacements);
  std::copy(dense.begin(), dense.end(), table.begin() + slot * row);
  scale_set(table, slot, options.intensity);
  if (is_viseme) {
    frame.viseme1 = slot;
    frame.viseme_blend = SEMBLANTE_BLEND_MAX;
  } else {
    frame.expression1 = slot;
    frame.intensity1 = SEMBLANTE_BLEND_MAX;
  }
}

semblante_pose neutral_pose(const KernelRig& kernel) {
  semblante_frame frame{};
  semblante_pose pose{};
  const semblante_rig rig = kernel.view();
  semblante_evaluate(&rig, &frame, &pose);
  return pose;
}

void displace_points(const std::string& path, const Head& head, semblante_pose& pose) {
  const auto json = read_file(path, max_displacements_bytes);
  const auto displacements = parse_displacements({reinterpret_cast<const char*>(json.data()), json.size()});
  if (!displacements) fail(path, displacements.error());
  for (const auto& [id, value] : *displacements) {
    const std::string where = std::string("/").append(to_string(id));
    const FeaturePoint* const point = find_point(head.rig, id);
    if (point == nullptr) {
      fail(path, {ErrorCode::missing, where, "this feature point is not marked in the feature point file"});
    }
    if (!point->vertex) {
      fail(path, {ErrorCode::invalid_argument, where, "this feature point is a bare position and moves no vertex"});
    }
    const glm::dvec3 moved = head.to_mpeg4 * value;
    for (int axis = 0; axis < 3; ++axis) pose.fp[id.value() * 3 + axis] = static_cast<float>(moved[axis]);
  }
}

}  // namespace

semblante_pose make_pose(const FaceOptions& options, const Head& head, std::vector<std::string>& warnings) {
  const Rig& rig = head.rig;
  KernelRig kernel = make_kernel_rig(rig);
  if (!options.displacements.empty()) {
    semblante_pose pose = neutral_pose(kernel);
    displace_points(options.displacements, head, pose);
    return pose;
  }
  semblante_frame frame{};
  if (!options.faps.empty()) parse_faps(options.faps, rig, frame, warnings);
  if (!options.viseme.empty()) {
    frame.viseme1 = find_entry("--viseme", options.viseme, viseme_library(), 0);
    frame.viseme_blend = SEMBLANTE_BLEND_MAX;
    check_set("--viseme", viseme_library()[frame.viseme1], rig, warnings);
    scale_set(kernel.visemes, frame.viseme1, options.intensity);
  }
  if (!options.expression.empty()) {
    frame.expression1 = find_entry("--expression", options.expression, expression_library(), 1);
    frame.intensity1 = SEMBLANTE_BLEND_MAX;
    check_set("--expression", expression_library()[frame.expression1], rig, warnings);
    scale_set(kernel.expressions, frame.expression1, options.intensity);
  }
  if (!options.set.empty()) wear_set(options, rig, kernel, frame, warnings);
  semblante_pose pose{};
  const semblante_rig view = kernel.view();
  semblante_evaluate(&view, &frame, &pose);
  return pose;
}

}  // namespace semblante

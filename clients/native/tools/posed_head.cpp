#include "clients/native/tools/posed_head.h"

#include <charconv>
#include <sstream>
#include <string_view>

#include "clients/native/tools/files.h"
#include "core/geometry/surface.h"
#include "core/import/axes.h"
#include "core/import/feature_points_file.h"
#include "core/lod/decimate.h"
#include "core/lod/lod_poses.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"

namespace semblante::tools {

static_assert(sizeof(glm::vec3) == 3 * sizeof(float), "positions are handed to the kernel as packed floats");

std::vector<glm::vec3> PosedHead::pose(const semblante_frame& frame) const {
  const semblante_rig view = kernel_rig.view();
  semblante_pose pose;
  semblante_evaluate(&view, &frame, &pose);
  const semblante_face face = make_kernel_face(rig, &model.positions[0].x);
  std::vector<glm::vec3> positions(model.positions.size());
  semblante_deform(&face, &pose, &positions[0].x);
  return positions;
}

std::vector<PartRole> PosedHead::roles() const {
  std::vector<PartRole> roles(rig.part_of_vertex.size());
  for (std::size_t v = 0; v < roles.size(); ++v) {
    roles[v] = rig.parts[rig.part_of_vertex[v].value()].role;
  }
  return roles;
}

namespace {

Status decimate_head(PosedHead& head, const Surface& surface, std::uint32_t max_vertices) {
  const std::vector<LodPose> poses = lod_poses(head.rig, head.model);
  LodOptions options;
  options.budgets = {max_vertices};
  options.poses = poses;
  const auto levels = decimate(head.model, surface, head.rig, options);
  if (!levels) {
    return levels.error();
  }
  if (levels->empty() || levels->back().vertex_count > max_vertices) {
    head.warnings.push_back("there is no level of " + std::to_string(max_vertices) + " vertices");
  }
  if (!levels->empty()) {
    apply_level(head.model, levels->back());
  }
  return Unit{};
}

}  // namespace

Result<PosedHead> load_posed_head(const std::filesystem::path& model_path, const std::filesystem::path& feature_points,
                                  WeightMethod weights, std::uint32_t max_vertices) {
  auto model = load_model(model_path);
  if (!model) {
    return std::move(model).error();
  }
  const auto bytes = read_file(feature_points);
  if (!bytes) {
    return bytes.error();
  }
  auto file = parse_feature_points({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (!file) {
    Error error = std::move(file).error();
    error.where = feature_points.string() + error.where;
    return error;
  }
  if (file->to_mpeg4_axes) {
    change_axes(*model, *file->to_mpeg4_axes);
    change_axes(*file);
  }
  PosedHead head;
  const Surface surface = build_surface(*model);
  auto placed = place_feature_points(*model, surface, file->points, &head.warnings);
  if (!placed) {
    return std::move(placed).error();
  }
  ParametrizeOptions options;
  options.weights = weights;
  auto rig = parametrize(*model, surface, *placed, options);
  if (!rig) {
    return std::move(rig).error();
  }
  head.model = *std::move(model);
  head.rig = *std::move(rig);
  head.kernel_rig = make_kernel_rig(head.rig);
  if (max_vertices > 0) {
    if (auto made = decimate_head(head, surface, max_vertices); !made) {
      return std::move(made).error();
    }
  }
  head.warnings.insert(head.warnings.end(), head.rig.warnings.begin(), head.rig.warnings.end());
  return head;
}

Result<semblante_frame> parse_faps(const std::string& text) {
  semblante_frame frame{};
  std::istringstream entries(text);
  for (std::string entry; std::getline(entries, entry, ',');) {
    const std::size_t equals = entry.find('=');
    int number = 0;
    float value = 0;
    const auto whole = [](std::string_view digits, auto& to) {
      const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), to);
      return problem == std::errc{} && end == digits.data() + digits.size();
    };
    if (equals == std::string::npos || !whole(std::string_view(entry).substr(0, equals), number) ||
        !whole(std::string_view(entry).substr(equals + 1), value) || number < 3 || number > SEMBLANTE_FAP_COUNT) {
      return Error{ErrorCode::invalid_argument, entry, "FAPs are written NUMBER=VALUE,... with numbers 3 to 68"};
    }
    frame.fap[number] = value;
  }
  return frame;
}

}  // namespace semblante::tools

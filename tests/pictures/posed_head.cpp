#include "tests/pictures/posed_head.h"

#include <charconv>
#include <sstream>
#include <string_view>
#include <utility>

#include "clients/native/tools/files.h"
#include "core/pipeline/levelled.h"
#include "core/pipeline/points_file.h"
#include "server/cli/folder_resources.h"

namespace semblante::pictures {

static_assert(sizeof(glm::vec3) == 3 * sizeof(float), "the kernel gets positions as packed floats");

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

Result<MarkedHead> load_marked(const std::filesystem::path& model, const std::filesystem::path& feature_points) {
  auto head = load_model(model);
  if (!head) {
    return std::move(head).error();
  }
  const auto bytes = tools::read_file(feature_points);
  if (!bytes) {
    return bytes.error();
  }
  auto file = parse_feature_points({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (!file) {
    return tools::in_file(feature_points, std::move(file).error());
  }
  auto marked = mark_by_file(*std::move(head), *std::move(file));
  if (!marked) {
    return tools::in_file(feature_points, std::move(marked).error());
  }
  return marked;
}

std::vector<std::uint32_t> budget_of(std::uint32_t max_vertices) {
  return max_vertices > 0 ? std::vector{max_vertices} : std::vector<std::uint32_t>();
}

}  // namespace

Result<ImportedHead> load_model(const std::filesystem::path& path) {
  const auto bytes = tools::read_file(path);
  if (!bytes) {
    return bytes.error();
  }
  auto head = import_head(*bytes, {path.filename().string(), std::nullopt, {}, folder_resources(path.string())});
  if (!head) {
    return tools::in_file(path, std::move(head).error());
  }
  return head;
}

Result<PosedHead> load_posed_head(const std::filesystem::path& model_path, const std::filesystem::path& feature_points,
                                  WeightMethod weights, std::uint32_t max_vertices) {
  auto marked = load_marked(model_path, feature_points);
  if (!marked) {
    return std::move(marked).error();
  }
  auto rigged = rig_head(*std::move(marked), {weights, DistanceMetric::edge});
  if (!rigged) {
    return tools::in_file(model_path, std::move(rigged).error());
  }
  auto levelled = level_head(*std::move(rigged), budget_of(max_vertices));
  if (!levelled) {
    return tools::in_file(model_path, std::move(levelled).error());
  }
  PosedHead head;
  head.warnings = levelled->warnings.all();
  head.model = std::move(levelled->model);
  head.rig = std::move(levelled->rig);
  head.kernel_rig = make_kernel_rig(head.rig);
  if (!levelled->levels.empty()) {
    apply_level(head.model, levelled->levels.back());
  }
  return head;
}

std::map<std::string, WeightMethod> weight_methods() {
  std::map<std::string, WeightMethod> methods;
  for (const std::string_view name : weight_method_names) methods.emplace(name, parse_weight_method(name).value());
  return methods;
}

std::string weight_method_list() {
  std::string list;
  for (const std::string_view name : weight_method_names) list.append(list.empty() ? "" : ", ").append(name);
  return list;
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
      return Error{ErrorCode::invalid_argument, entry, "FAPs must be NUMBER=VALUE,... with numbers from 3 to 68"};
    }
    frame.fap[number] = value;
  }
  return frame;
}

}  // namespace semblante::pictures

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "core/json/json_cursor.h"
#include "core/json/json_tree.h"
#include "core/types/decimal.h"
#include "protocol/cpp/rig_document.h"
#include "protocol/cpp/weights_format.h"
#include "protocol/cpp/weights_layout.h"

namespace semblante {
namespace {

/// The longest list has 100,000 parts of a dozen values each.
constexpr JsonLimits rig_limits = {.max_bytes = 16U << 20U, .max_depth = 64, .max_values = 2'000'000};
constexpr std::size_t max_rig_text_bytes = 4096;
constexpr std::size_t max_list = 100'000;  // parts, materials, warnings: bounds a hostile file
constexpr std::uint64_t max_u32 = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t max_exact = (1ULL << 53U) - 1;
constexpr double greatest_share = 10.0;  // of a companion
constexpr float max_float = std::numeric_limits<float>::max();

float real(const JsonCursor& at) { return static_cast<float>(at.number(-max_float, max_float)); }

std::uint32_t natural(const JsonCursor& at) { return static_cast<std::uint32_t>(at.integer(0, max_u32)); }

glm::vec3 vec3(const JsonCursor& at) {
  const auto values = at.elements(3, 3);
  if (values.empty()) return glm::vec3(0.0F);
  return {real(values[0]), real(values[1]), real(values[2])};
}

Sha256 hash(const JsonCursor& at) {
  const auto parsed = parse_sha256(at.text(64));
  if (!parsed) at.fail(ErrorCode::malformed, "must be a SHA-256 as 64 hexadecimal digits");
  return parsed.value_or(Sha256{});
}

std::optional<Sha256> hash_or_null(const JsonCursor& at) {
  return at.is_null() ? std::nullopt : std::optional(hash(at));
}

std::optional<std::uint32_t> natural_or_null(const JsonCursor& at) {
  return at.is_null() ? std::nullopt : std::optional(natural(at));
}

FeaturePointId point_id(const JsonCursor& at, std::string_view text) {
  const auto id = parse_feature_point(text);
  if (!id) at.fail(ErrorCode::invalid_argument, "no feature point is called \"" + std::string(text) + "\"");
  return id.value_or(FeaturePointId());
}

template <std::size_t N>
std::size_t index_in(const JsonCursor& at, const std::array<std::string_view, N>& names) {
  const std::string text = at.text(max_rig_text_bytes);
  for (std::size_t i = 0; i < N; ++i) {
    if (names[i] == text) return i;
  }
  at.fail(ErrorCode::invalid_argument, "\"" + text + "\" is not one of the known values");
  return 0;
}

RigDocument::Mesh mesh(const JsonCursor& at) {
  RigDocument::Mesh result;
  result.sha256 = hash(at.member("sha256"));
  result.vertices = static_cast<std::uint32_t>(at.member("vertices").integer(1, max_weights_vertices));
  result.triangles = natural(at.member("triangles"));
  result.bytes = at.member("bytes").integer(0, max_exact);
  const JsonCursor attributes = at.member("attributes");
  result.attributes.position = natural_or_null(attributes.member("position"));
  if (!result.attributes.position) attributes.member("position").fail(ErrorCode::missing, "a mesh has positions");
  result.attributes.normal = natural_or_null(attributes.member("normal"));
  result.attributes.uv = natural_or_null(attributes.member("uv"));
  result.attributes.material = natural_or_null(attributes.member("material"));
  result.attributes.file_vertex = natural_or_null(attributes.member("file_vertex"));
  if (attributes.has("color")) result.attributes.color = natural_or_null(attributes.member("color"));
  return result;
}

RigDocument::Weights weights(const JsonCursor& at) {
  RigDocument::Weights result;
  result.sha256 = hash(at.member("sha256"));
  result.bytes = at.member("bytes").integer(0, max_exact);
  result.bits = static_cast<int>(at.member("bits").integer(weights_layout::min_bits, weights_layout::max_bits));
  result.max_influences = static_cast<std::uint32_t>(at.member("max_influences").integer(0, feature_point_count));
  result.mean_influences = at.member("mean_influences").number(0.0, feature_point_count);
  result.max_error = at.member("max_error").number(0.0, 1.0);
  return result;
}

RigDocument::Level level(const JsonCursor& at) {
  return {natural(at.member("vertices")), natural(at.member("triangles")), at.member("bytes").integer(0, max_exact)};
}

RigDocument::Point point(const JsonCursor& at, std::uint32_t vertices) {
  RigDocument::Point result;
  const JsonCursor id = at.member("id");
  result.id = point_id(id, id.text(max_rig_text_bytes));
  const JsonCursor vertex = at.member("vertex");
  if (!vertex.is_null()) result.vertex = static_cast<std::uint32_t>(vertex.integer(0, vertices - 1));
  result.position = vec3(at.member("position"));
  return result;
}

template <std::size_t N>
void displacement_sets(const JsonCursor& at, std::array<RigDocument::DisplacementSet, N>& sets) {
  const auto elements = at.elements(N, N);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    sets[i].name = elements[i].member("name").text(max_rig_text_bytes);
    for (const auto& [name, value] : elements[i].member("displacements").members()) {
      sets[i].displacements.push_back({point_id(value, name), vec3(value)});
    }
    // By heap, which is a fifth of the code of std::sort.
    const auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };
    std::make_heap(sets[i].displacements.begin(), sets[i].displacements.end(), by_id);
    std::sort_heap(sets[i].displacements.begin(), sets[i].displacements.end(), by_id);
  }
}

/// Reads a unit vector, with a tolerance for rounded digits.
glm::vec3 direction(const JsonCursor& at) {
  const glm::vec3 v = vec3(at);
  const double square = glm::dot(glm::dvec3(v), glm::dvec3(v));
  if (!(std::abs(square - 1.0) < 1e-3)) at.fail(ErrorCode::out_of_range, "must be a unit vector");
  return v;
}

float above(const JsonCursor& at, float least) {
  const float value = real(at);
  if (!(value > least)) at.fail(ErrorCode::out_of_range, "must be more than " + shortest_fixed_text(least));
  return value;
}

std::optional<Iris> iris(const JsonCursor& at) {
  if (at.is_null()) return std::nullopt;
  Iris result;
  result.axis = direction(at.member("axis"));
  result.pupil_radius = above(at.member("pupil_radius"), 0.0F);
  result.iris_radius = above(at.member("iris_radius"), result.pupil_radius);
  result.bend = real(at.member("bend"));
  return result;
}

Tongue tongue(const JsonCursor& at) {
  Tongue result;
  result.origin = vec3(at.member("origin"));
  result.left = direction(at.member("left"));
  result.up = direction(at.member("up"));
  if (!(std::abs(glm::dot(result.left, result.up)) < 1e-3F)) {
    at.member("up").fail(ErrorCode::out_of_range, "must be perpendicular to left");
  }
  result.half_width = above(at.member("half_width"), 0.0F);
  result.roll_limit = static_cast<float>(at.member("roll_limit").number(0.0, 7.0));
  return result;
}

template <std::size_t N>
std::array<float, N> list(const JsonCursor& at, float low, float high) {
  std::array<float, N> result{};
  const auto values = at.elements(N, N);
  for (std::size_t i = 0; i < values.size(); ++i) result[i] = static_cast<float>(values[i].number(low, high));
  return result;
}

std::optional<Lids> lids(const JsonCursor& at) {
  if (at.is_null()) return std::nullopt;
  constexpr double half_turn = 3.2;
  Lids result;
  result.gaze = direction(at.member("gaze"));
  result.slit = static_cast<float>(at.member("slit").number(0.0, half_turn));
  result.opening = above(at.member("opening"), 0.0F);
  result.gaze_share = list<2>(at.member("gaze_share"), 0.0F, 1.0F);
  result.ball = list<Lids::ball_places>(at.member("ball"), 0.0F, max_float);
  if (const auto lift = at.optional_member("lift")) result.lift = static_cast<float>(lift->number(0.0, 1.0));
  return result;
}

void read_companions(const JsonCursor& at, bool is_choice, std::vector<Companion>& companions) {
  for (const auto& [point, leaders] : at.members()) {
    for (const auto& [leader, share] : leaders.members()) {
      companions.push_back({point_id(leaders, point), point_id(share, leader),
                            static_cast<float>(share.number(-greatest_share, greatest_share)), is_choice});
    }
  }
}

RigDocument::PartInfo part(const JsonCursor& at) {
  RigDocument::PartInfo result;
  result.name = at.member("name").text(max_rig_text_bytes);
  result.role = static_cast<PartRole>(index_in(at.member("role"), part_role_names));
  result.vertices = natural(at.member("vertices"));
  result.triangles = natural(at.member("triangles"));
  return result;
}

RigDocument::MaterialInfo material(const JsonCursor& at) {
  static constexpr std::array<std::string_view, 3> alpha_modes = {"opaque", "mask", "blend"};
  RigDocument::MaterialInfo result;
  result.name = at.member("name").text(max_rig_text_bytes);
  const auto color = at.member("base_color").elements(4, 4);
  if (!color.empty()) result.base_color = {real(color[0]), real(color[1]), real(color[2]), real(color[3])};
  result.metallic = real(at.member("metallic"));
  result.roughness = real(at.member("roughness"));
  result.alpha_mode = static_cast<RigDocument::MaterialInfo::AlphaMode>(index_in(at.member("alpha_mode"), alpha_modes));
  result.alpha_cutoff = real(at.member("alpha_cutoff"));
  result.double_sided = at.member("double_sided").boolean();
  result.base_color_image = hash_or_null(at.member("base_color_image"));
  result.normal_image = hash_or_null(at.member("normal_image"));
  return result;
}

RigDocument::ImageInfo image(const JsonCursor& at) {
  return {hash(at.member("sha256")), at.member("mime_type").text(max_rig_text_bytes),
          at.member("bytes").integer(0, max_exact)};
}

}  // namespace

Result<RigDocument> read_rig(std::string_view text) {
  const auto tree = read_json_object_tree(text, rig_limits);
  if (!tree) return tree.error();
  JsonCursor::Report report;
  const JsonCursor root(*tree, report);

  RigDocument rig;
  if (root.member("format").text(max_rig_text_bytes) != "semblante.rig") {
    root.member("format").fail(ErrorCode::malformed, "must be \"semblante.rig\"");
  }
  if (root.member("version").integer(0, max_u32) != 1) {
    root.member("version").fail(ErrorCode::unsupported, "only version 1 is known");
  }
  rig.name = root.member("name").text(max_rig_text_bytes);
  if (const auto levels = root.optional_member("levels")) {
    for (const auto& at : levels->elements(1, max_list)) rig.levels.push_back(level(at));
    if (!rig.levels.empty()) {
      rig.lod = static_cast<std::uint32_t>(root.member("lod").integer(0, rig.levels.size() - 1));
    }
  }
  rig.mesh = mesh(root.member("mesh"));
  rig.weights = weights(root.member("weights"));
  const JsonCursor fapu = root.member("fapu");
  for (std::size_t i = 0; i < fapu_unit_count; ++i) {
    const JsonCursor unit = fapu.member(fapu_unit_names[i]);
    if (!unit.is_null()) rig.fapu.value[i] = unit.number();
  }
  for (const auto& at : root.member("feature_points").elements(0, feature_point_count)) {
    const RigDocument::Point read = point(at, rig.mesh.vertices);
    if (!rig.feature_points.empty() && rig.feature_points.back().id >= read.id) {
      at.member("id").fail(ErrorCode::malformed, "ids must be increasing");
    }
    rig.feature_points.push_back(read);
  }
  const auto pivots = root.member("eye_pivots").elements(2, 2);
  for (std::size_t i = 0; i < pivots.size(); ++i) rig.eye_pivots[i] = vec3(pivots[i]);
  rig.head_pivot = vec3(root.member("head_pivot"));
  if (const auto irises = root.optional_member("irises")) {
    const auto eyes = irises->elements(2, 2);
    for (std::size_t i = 0; i < eyes.size(); ++i) rig.irises[i] = iris(eyes[i]);
  }
  if (const auto at = root.optional_member("tongue"); at && !at->is_null()) rig.tongue = tongue(*at);
  if (const auto lids_of_eyes = root.optional_member("lids")) {
    const auto eyes = lids_of_eyes->elements(2, 2);
    for (std::size_t i = 0; i < eyes.size(); ++i) rig.lids[i] = lids(eyes[i]);
  }
  for (const auto& at : root.member("parts").elements(0, max_list)) rig.parts.push_back(part(at));
  if (const auto at = root.optional_member("companions")) read_companions(*at, false, rig.companions);
  if (const auto at = root.optional_member("lower_lip")) read_companions(*at, true, rig.companions);
  rig.viseme_share = root.member("viseme_share").number(0.0, 1.0);
  if (const auto at = root.optional_member("articulation")) {
    rig.articulation = at->number(least_articulation, most_articulation);
  }
  displacement_sets(root.member("visemes"), rig.visemes);
  displacement_sets(root.member("expressions"), rig.expressions);
  rig.bounds_min = vec3(root.member("bounds").member("min"));
  rig.bounds_max = vec3(root.member("bounds").member("max"));
  for (const auto& at : root.member("materials").elements(1, 256)) rig.materials.push_back(material(at));
  for (const auto& at : root.member("images").elements(0, max_list)) rig.images.push_back(image(at));
  for (const auto& at : root.member("warnings").elements(0, max_list))
    rig.warnings.push_back(at.text(max_rig_text_bytes));
  if (report) return *report;
  return rig;
}

}  // namespace semblante

#include <charconv>

#include <nlohmann/json.hpp>

#include "protocol/cpp/rig_document.h"

namespace semblante {
namespace {

using nlohmann::ordered_json;

/// The double with the fewest digits that rounds to this float: 0.1F is written as 0.1, not 0.10000000149011612.
double shortest(float value) {
  char digits[32];
  const auto [end, status] = std::to_chars(std::begin(digits), std::end(digits), value);
  double result = 0.0;
  std::from_chars(std::begin(digits), end, result);
  return status == std::errc() ? result : static_cast<double>(value);
}

/// Rounds a displacement to five significant digits: weights have 12 bits, and displacements are most of rig.json.
double five_digits(float value) {
  char digits[32];
  const auto [end, status] = std::to_chars(std::begin(digits), std::end(digits), value, std::chars_format::general, 5);
  double result = 0.0;
  std::from_chars(std::begin(digits), end, result);
  return status == std::errc() ? result : static_cast<double>(value);
}

/// Writes zero as 0 instead of 0.0 or -0.0, to save bytes: a third of the components are zero.
ordered_json component(float value) { return value == 0.0F ? ordered_json(0) : ordered_json(five_digits(value)); }

ordered_json vector_of(const glm::vec3& v) { return {shortest(v.x), shortest(v.y), shortest(v.z)}; }

template <class T>
ordered_json or_null(const std::optional<T>& value) {
  return value.has_value() ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json hash_or_null(const std::optional<Sha256>& hash) {
  return hash.has_value() ? ordered_json(to_hex(*hash)) : ordered_json(nullptr);
}

template <std::size_t N>
ordered_json sets_of(const std::array<RigDocument::DisplacementSet, N>& sets) {
  ordered_json result = ordered_json::array();
  for (const auto& set : sets) {
    ordered_json displacements = ordered_json::object();
    for (const auto& displacement : set.displacements)
      displacements[to_string(displacement.id)] = {component(displacement.by.x), component(displacement.by.y),
                                                   component(displacement.by.z)};
    result.push_back({{"name", set.name}, {"displacements", std::move(displacements)}});
  }
  return result;
}

/// {point: {leader: share}} of the companions with the given `is_choice`.
ordered_json companions_of(const std::vector<Companion>& companions, bool is_choice) {
  ordered_json result = ordered_json::object();
  for (const Companion& companion : companions) {
    if (companion.is_choice == is_choice)
      result[to_string(companion.point)][to_string(companion.leader)] = shortest(companion.share);
  }
  return result;
}

ordered_json material_of(const RigDocument::MaterialInfo& material) {
  static constexpr std::array<const char*, 3> alpha_modes = {"opaque", "mask", "blend"};
  return {{"name", material.name},
          {"base_color",
           {shortest(material.base_color.x), shortest(material.base_color.y), shortest(material.base_color.z),
            shortest(material.base_color.w)}},
          {"metallic", shortest(material.metallic)},
          {"roughness", shortest(material.roughness)},
          {"alpha_mode", alpha_modes[static_cast<std::size_t>(material.alpha_mode)]},
          {"alpha_cutoff", shortest(material.alpha_cutoff)},
          {"double_sided", material.double_sided},
          {"base_color_image", hash_or_null(material.base_color_image)},
          {"normal_image", hash_or_null(material.normal_image)}};
}

ordered_json iris_of(const std::optional<Iris>& iris) {
  if (!iris) return nullptr;
  return {{"axis", vector_of(iris->axis)},
          {"pupil_radius", shortest(iris->pupil_radius)},
          {"iris_radius", shortest(iris->iris_radius)},
          {"bend", shortest(iris->bend)}};
}

ordered_json tongue_of(const Tongue& tongue) {
  return {{"origin", vector_of(tongue.origin)},
          {"left", vector_of(tongue.left)},
          {"up", vector_of(tongue.up)},
          {"half_width", shortest(tongue.half_width)},
          {"roll_limit", shortest(tongue.roll_limit)}};
}

template <std::size_t N>
ordered_json list_of(const std::array<float, N>& values) {
  ordered_json result = ordered_json::array();
  for (const float value : values) result.push_back(shortest(value));
  return result;
}

ordered_json lids_of(const std::optional<Lids>& lids) {
  if (!lids) return nullptr;
  ordered_json json = {{"gaze", vector_of(lids->gaze)},
                       {"slit", shortest(lids->slit)},
                       {"opening", shortest(lids->opening)},
                       {"gaze_share", list_of(lids->gaze_share)},
                       {"ball", list_of(lids->ball)}};
  if (lids->lift > 0.0F) json["lift"] = shortest(lids->lift);
  return json;
}

}  // namespace

std::string write_rig(const RigDocument& rig) {
  ordered_json json;
  json["format"] = "semblante.rig";
  json["version"] = 1;
  json["name"] = rig.name;
  if (!rig.levels.empty()) {
    json["lod"] = rig.lod;
    json["levels"] = ordered_json::array();
    for (const auto& level : rig.levels) {
      json["levels"].push_back({{"vertices", level.vertices}, {"triangles", level.triangles}, {"bytes", level.bytes}});
    }
  }
  const auto& attributes = rig.mesh.attributes;
  json["mesh"] = {{"sha256", to_hex(rig.mesh.sha256)},
                  {"vertices", rig.mesh.vertices},
                  {"triangles", rig.mesh.triangles},
                  {"bytes", rig.mesh.bytes},
                  {"attributes",
                   {{"position", or_null(attributes.position)},
                    {"normal", or_null(attributes.normal)},
                    {"uv", or_null(attributes.uv)},
                    {"material", or_null(attributes.material)},
                    {"file_vertex", or_null(attributes.file_vertex)}}}};
  if (attributes.color) json["mesh"]["attributes"]["color"] = *attributes.color;
  json["weights"] = {{"sha256", to_hex(rig.weights.sha256)},
                     {"bytes", rig.weights.bytes},
                     {"bits", rig.weights.bits},
                     {"max_influences", rig.weights.max_influences},
                     {"mean_influences", rig.weights.mean_influences},
                     {"max_error", rig.weights.max_error}};
  json["fapu"] = ordered_json::object();
  for (std::size_t i = 0; i < fapu_unit_count; ++i) {
    json["fapu"][std::string(fapu_unit_names[i])] = or_null(rig.fapu.value[i]);
  }
  json["feature_points"] = ordered_json::array();
  for (const auto& point : rig.feature_points) {
    json["feature_points"].push_back(
        {{"id", to_string(point.id)}, {"vertex", or_null(point.vertex)}, {"position", vector_of(point.position)}});
  }
  json["eye_pivots"] = {vector_of(rig.eye_pivots[0]), vector_of(rig.eye_pivots[1])};
  json["head_pivot"] = vector_of(rig.head_pivot);
  if (rig.irises[0] || rig.irises[1]) json["irises"] = {iris_of(rig.irises[0]), iris_of(rig.irises[1])};
  if (rig.tongue) json["tongue"] = tongue_of(*rig.tongue);
  if (rig.lids[0] || rig.lids[1]) json["lids"] = {lids_of(rig.lids[0]), lids_of(rig.lids[1])};
  json["parts"] = ordered_json::array();
  for (const auto& part : rig.parts) {
    json["parts"].push_back({{"name", part.name},
                             {"role", part_role_names[static_cast<std::size_t>(part.role)]},
                             {"vertices", part.vertices},
                             {"triangles", part.triangles}});
  }
  for (const bool is_choice : {false, true}) {
    ordered_json companions = companions_of(rig.companions, is_choice);
    if (!companions.empty()) json[is_choice ? "lower_lip" : "companions"] = std::move(companions);
  }
  json["viseme_share"] = rig.viseme_share;
  if (rig.articulation != usual_articulation) json["articulation"] = rig.articulation;
  json["visemes"] = sets_of(rig.visemes);
  json["expressions"] = sets_of(rig.expressions);
  json["bounds"] = {{"min", vector_of(rig.bounds_min)}, {"max", vector_of(rig.bounds_max)}};
  json["materials"] = ordered_json::array();
  for (const auto& material : rig.materials) json["materials"].push_back(material_of(material));
  json["images"] = ordered_json::array();
  for (const auto& image : rig.images) {
    json["images"].push_back(
        {{"sha256", to_hex(image.sha256)}, {"mime_type", image.mime_type}, {"bytes", image.bytes}});
  }
  json["warnings"] = rig.warnings;
  // Names come from model files: bytes that are not UTF-8 are replaced rather than refused.
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace semblante

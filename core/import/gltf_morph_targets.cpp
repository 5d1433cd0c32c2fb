#include "core/import/gltf_morph_targets.h"

#include <algorithm>
#include <cmath>

#include "core/import/text.h"
#include "core/types/printable.h"

namespace semblante::import {
namespace {

/// ARKit has 52 targets, a game head a few hundred.
constexpr std::size_t max_examples = 4096;

/// Maximum number of weights looked at: many nodes may show one mesh of many targets.
constexpr std::size_t max_weights = 65536;
constexpr double least_shown_weight = 0.01;

}  // namespace

std::vector<std::string> MorphTargets::names_of(const JsonCursor& mesh, const JsonCursor& primitive, std::size_t most) {
  for (const JsonCursor* const owner : {&mesh, &primitive}) {
    if (!owner->has("extras")) continue;
    auto names = owner->member("extras").texts("targetNames", most);
    if (!names.empty()) return names;
  }
  return {};
}

std::string MorphTargets::name_of(const std::vector<std::string>& names, std::size_t target) {
  return target < names.size() && !names[target].empty() ? printable(names[target])
                                                         : "target " + std::to_string(target);
}

Example& MorphTargets::example(const std::string& name) {
  auto& examples = builder_.model.examples;
  const auto [entry, is_new] = by_name_.try_emplace(name, examples.size());
  if (is_new) examples.push_back({name, {}, {}});
  return examples[entry->second];
}

void MorphTargets::read(const JsonCursor& mesh, const JsonCursor& primitive, std::size_t first, std::size_t count,
                        const VertexTransform& transform) {
  const std::size_t target_count = primitive.size_of("targets");
  if (target_count == 0 || document_.failed()) return;
  if (target_count > max_examples || by_name_.size() > max_examples) {
    primitive.member("targets").fail(ErrorCode::too_large,
                                     "more than " + std::to_string(max_examples) + " morph targets");
    return;
  }
  const std::vector<std::string> names = names_of(mesh, primitive, target_count);
  for (std::size_t i = 0; i < target_count && !document_.failed(); ++i) {
    const JsonCursor target = primitive.member("targets").element(i);
    const auto accessor = target.index("POSITION", document_.count("accessors"));
    if (document_.failed()) return;
    if (!accessor) continue;
    if (document_.item("accessors", *accessor).member("count").integer(0, ~std::uint64_t{0}) != count) {
      // Draco may have merged vertices that are separate in a target.
      builder_.warn(target.pointer() + " has a different number of vertices than its primitive and is omitted");
      continue;
    }
    const auto rows = document_.rows(*accessor, count, rows_left_);
    if (document_.failed()) return;
    if (rows_left_ == 0) {
      if (!has_warned_)
        builder_.warn("the morph targets have more displacements than the limit; the last targets are omitted");
      has_warned_ = true;
      return;
    }
    const std::string name = name_of(names, i);
    Example& kept = example(name);
    // If one mesh uses a name twice, a vertex would be listed twice: the first is kept.
    const bool follows = kept.vertices.empty() || kept.vertices.back() < first;
    for (const auto& [index, value] : rows) {
      if (!follows) break;
      const auto vertex = static_cast<std::uint32_t>(first + index);
      kept.vertices.push_back(vertex);
      kept.displacements.push_back(transform.displacement(index, glm::vec3(value[0], value[1], value[2])));
    }
    if (!follows && !rows.empty())
      builder_.warn(target.pointer() + " has the same name " + shown(name) + " as an earlier target and is omitted");
  }
}

void MorphTargets::warn_of_shown() {
  JsonCursor::Report ignored;
  const JsonCursor root = document_.root(ignored);
  const std::size_t mesh_count = root.size_of("meshes");
  std::size_t left = max_weights;
  for (std::size_t i = 0; i < root.size_of("nodes") && !root.failed(); ++i) {
    const JsonCursor node = root.member("nodes").element(i);
    const auto index = node.index("mesh", mesh_count);
    if (!index) continue;
    const JsonCursor mesh = root.member("meshes").element(*index);
    if (mesh.size_of("primitives") == 0) continue;
    const JsonCursor& owner = node.has("weights") ? node : mesh;
    const std::size_t count = std::min(owner.size_of("weights"), left);
    left -= count;
    for (std::size_t target = 0; target < count; ++target) {
      const double weight = owner.member("weights").element(target).number();
      if (std::abs(weight) < least_shown_weight) continue;
      const auto names = names_of(mesh, mesh.member("primitives").element(0), target + 1);
      builder_.warn("the file shows its morph target " + shown(name_of(names, target)) + " at " +
                    in_three_digits(weight) + "; the head is read without it");
      return;
    }
  }
}

}  // namespace semblante::import

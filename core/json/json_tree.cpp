#include "core/json/json_tree.h"

#include <algorithm>

namespace semblante {

const char* kind_name(JsonKind kind) {
  switch (kind) {
    case JsonKind::null:
      return "null";
    case JsonKind::boolean:
      return "true or false";
    case JsonKind::text:
      return "a string";
    case JsonKind::array:
      return "an array";
    case JsonKind::object:
      return "an object";
    default:
      return "a number";
  }
}

std::string_view JsonTree::name_of(const Node& node) const {
  return std::string_view(texts_).substr(node.name, node.name_size);
}

JsonKind JsonTree::kind(const void* node) const { return static_cast<const Node*>(node)->kind; }

std::size_t JsonTree::size(const void* node) const { return static_cast<const Node*>(node)->range.count; }

const void* JsonTree::element(const void* node, std::size_t index) const {
  return &nodes_[static_cast<const Node*>(node)->range.begin + index];
}

const void* JsonTree::member(const void* node, std::string_view name) const {
  const auto range = static_cast<const Node*>(node)->range;
  const Node* const begin = nodes_.data() + range.begin;
  const Node* const end = begin + range.count;
  const Node* const found =
      std::lower_bound(begin, end, name, [this](const Node& at, std::string_view to) { return name_of(at) < to; });
  return found != end && name_of(*found) == name ? found : nullptr;
}

void JsonTree::members(const void* node, void* context, Visit visit) const {
  const auto range = static_cast<const Node*>(node)->range;
  for (std::uint32_t i = 0; i < range.count; ++i) {
    const Node& member = nodes_[range.begin + i];
    visit(context, name_of(member), &member);
  }
}

double JsonTree::number(const void* node) const {
  const Node& value = *static_cast<const Node*>(node);
  if (value.kind == JsonKind::natural) return static_cast<double>(value.bits);
  if (value.kind == JsonKind::negative) return static_cast<double>(static_cast<std::int64_t>(value.bits));
  return value.real;
}

std::uint64_t JsonTree::natural(const void* node) const { return static_cast<const Node*>(node)->bits; }

std::int64_t JsonTree::negative(const void* node) const {
  return static_cast<std::int64_t>(static_cast<const Node*>(node)->bits);
}

std::string_view JsonTree::text(const void* node) const {
  const auto range = static_cast<const Node*>(node)->range;
  return std::string_view(texts_).substr(range.begin, range.count);
}

}  // namespace semblante

#include "core/json/read_json.h"

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.h"

namespace semblante {
namespace {

using nlohmann::json;

const json& value_at(const void* node) { return *static_cast<const json*>(node); }

/// Any document of nlohmann's: its nodes are its values.
class NlohmannHolder final : public JsonHolder {
 public:
  [[nodiscard]] JsonKind kind(const void* node) const override {
    const json& value = value_at(node);
    switch (value.type()) {
      case json::value_t::object:
        return JsonKind::object;
      case json::value_t::array:
        return JsonKind::array;
      case json::value_t::string:
        return JsonKind::text;
      case json::value_t::boolean:
        return JsonKind::boolean;
      case json::value_t::number_unsigned:
        return JsonKind::natural;
      case json::value_t::number_integer:
        return value.get<std::int64_t>() < 0 ? JsonKind::negative : JsonKind::natural;
      case json::value_t::number_float:
        return JsonKind::real;
      default:
        return JsonKind::null;
    }
  }
  [[nodiscard]] std::size_t size(const void* node) const override { return value_at(node).size(); }
  [[nodiscard]] const void* element(const void* node, std::size_t index) const override {
    return &value_at(node)[index];
  }
  [[nodiscard]] const void* member(const void* node, std::string_view name) const override {
    const auto found = value_at(node).find(name);
    return found == value_at(node).end() ? nullptr : &*found;
  }
  void members(const void* node, void* context, Visit visit) const override {
    for (const auto& [name, value] : value_at(node).get_ref<const json::object_t&>()) visit(context, name, &value);
  }
  [[nodiscard]] double number(const void* node) const override { return value_at(node).get<double>(); }
  [[nodiscard]] std::uint64_t natural(const void* node) const override {
    const json& value = value_at(node);
    return value.is_boolean() ? std::uint64_t{value.get<bool>()} : value.get<std::uint64_t>();
  }
  [[nodiscard]] std::int64_t negative(const void* node) const override { return value_at(node).get<std::int64_t>(); }
  [[nodiscard]] std::string_view text(const void* node) const override {
    return value_at(node).get_ref<const std::string&>();
  }
};

/// The depth of the recursion is within the limits that the text was read with.
json document_of(const JsonView& view) {
  switch (view.kind()) {
    case JsonKind::boolean:
      return view.natural() != 0;
    case JsonKind::natural:
      return view.natural();
    case JsonKind::negative:
      return view.negative();
    case JsonKind::real:
      return view.number();
    case JsonKind::text:
      return std::string(view.text());
    case JsonKind::array: {
      json::array_t array;
      array.reserve(view.size());
      for (std::size_t i = 0; i < view.size(); ++i) array.push_back(document_of(view.element(i)));
      return array;
    }
    case JsonKind::object: {
      json::object_t object;
      view.members([&](std::string_view name, const JsonView& value) {
        object.emplace_hint(object.end(), name, document_of(value));
      });
      return object;
    }
    default:
      return nullptr;
  }
}

Result<json> document_of(const Result<JsonTree>& tree) {
  if (!tree) return tree.error();
  return document_of(tree->root());
}

}  // namespace

JsonView json_view(const nlohmann::json& value) {
  static const NlohmannHolder holder;
  return {holder, &value};
}

Result<nlohmann::json> read_json(std::string_view text, const JsonLimits& limits) {
  return document_of(read_json_tree(text, limits));
}

Result<nlohmann::json> read_json_object(std::string_view text, const JsonLimits& limits) {
  return document_of(read_json_object_tree(text, limits));
}

}  // namespace semblante

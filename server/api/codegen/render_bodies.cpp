#include <set>

#include "server/api/codegen/render.h"

namespace semblante::codegen {
namespace {

class Bodies {
 public:
  explicit Bodies(const Json& document) : document_(document) {}

  /// Adds the schema of a JSON body under the name of its component, or else of its operation.
  void add(const std::string& name, const Json& schema) {
    if (const auto component = component_name(schema); !component.empty())
      return add(snake_case(component), follow(document_, schema));
    for (const char* const alternatives : {"anyOf", "oneOf"})
      if (schema.contains(alternatives))
        for (const auto& one : schema[alternatives]) add(name, one);
    const bool has_members = schema.contains("properties") || schema.contains("additionalProperties");
    if (!has_members || !seen_.insert(name).second) return;
    const Json properties = schema.value("properties", Json::object());
    text_ +=
        "inline constexpr std::array<std::string_view, " + std::to_string(properties.size()) + "> " + name + " = {";
    for (const auto& [member, rule] : properties.items()) text_ += quoted(member) + ", ";
    if (!properties.empty()) text_.resize(text_.size() - 2);
    text_ += "};\n";
    for (const auto& [member, rule] : properties.items())
      if (!component_name(rule).empty()) add(member, rule);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  const Json& document_;
  std::set<std::string> seen_;
  std::string text_;
};

}  // namespace

std::string render_body_members(const Json& document) {
  Bodies bodies(document);
  for (const auto& operation : operations(document)) {
    if (!operation.json->contains("requestBody")) continue;
    for (const auto& [type, media] : operation.json->at("requestBody").at("content").items()) {
      if (!media.contains("schema")) continue;
      if (type.ends_with("json")) bodies.add(operation.function, media["schema"]);
      if (type != "multipart/form-data") continue;
      for (const auto& [part, rule] : media["schema"].at("properties").items())
        if (!component_name(rule).empty()) bodies.add(part, rule);  // a part of JSON
    }
  }
  return generated_notice() +
         "#pragma once\n\n#include <array>\n#include <string_view>\n\n/// The names of the members that a JSON body "
         "or a part of a form may "
         "have, by its schema or, where that has no name, its operation.\nnamespace semblante::api::body_members "
         "{\n\n" +
         bodies.text() + "\n}  // namespace semblante::api::body_members\n";
}

}  // namespace semblante::codegen

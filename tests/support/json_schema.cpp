#include "tests/support/json_schema.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <regex>
#include <set>
#include <stdexcept>
#include <string_view>

#include <nlohmann/json.hpp>

namespace semblante::test {
namespace {

using nlohmann::json;

/// std::regex_search for an expression from a document. libstdc++ compiles expressions with a cache of the locale that
/// all threads share without a lock.
bool is_found(const std::string& expression, const std::string& text) {
  static std::mutex mutex;
  // Answers have hundreds of strings, and to compile an expression takes longer than everything else of a check.
  static std::map<std::string, std::regex> compiled;
  const std::lock_guard lock(mutex);
  return std::regex_search(text, compiled.try_emplace(expression, expression).first->second);
}

constexpr auto known_keywords = std::to_array<std::string_view>({"$ref",
                                                                 "additionalProperties",
                                                                 "allOf",
                                                                 "anyOf",
                                                                 "const",
                                                                 "default",
                                                                 "description",
                                                                 "enum",
                                                                 "example",
                                                                 "examples",
                                                                 "format",
                                                                 "items",
                                                                 "maxItems",
                                                                 "maxLength",
                                                                 "maximum",
                                                                 "minItems",
                                                                 "minLength",
                                                                 "minimum",
                                                                 "oneOf",
                                                                 "pattern",
                                                                 "properties",
                                                                 "required",
                                                                 "exclusiveMinimum",
                                                                 "propertyNames",
                                                                 "title",
                                                                 "type"});

/// What one schema says about one value.
struct Outcome {
  std::vector<std::string> faults;
  std::set<std::string> members;  ///< of an object: those that the schema names
  bool names_members = false;     ///< the schema says which members there are
  bool allows_others = false;     ///< `additionalProperties` answers for the rest

  void join(Outcome other) {
    faults.insert(faults.end(), other.faults.begin(), other.faults.end());
    members.merge(other.members);
    names_members |= other.names_members;
    allows_others |= other.allows_others;
  }
};

bool is_of_type(const json& value, const std::string& type) {
  if (type == "null") return value.is_null();
  if (type == "boolean") return value.is_boolean();
  if (type == "string") return value.is_string();
  if (type == "array") return value.is_array();
  if (type == "object") return value.is_object();
  if (type == "number") return value.is_number();
  if (type == "integer")
    return value.is_number_integer() || (value.is_number() && std::floor(value.get<double>()) == value.get<double>());
  throw std::logic_error("the validator does not know the type " + type);
}

std::size_t code_points(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

class Validator {
 public:
  Validator(const json& document, UnknownMembers unknown) : document_(document), unknown_(unknown) {}

  /// The value as a whole: every member must be known to one of the schemas that were applied to it.
  [[nodiscard]] Outcome whole(const json& schema, const json& value, const std::string& at) const {
    Outcome outcome = part(schema, value, at);
    if (unknown_ == UnknownMembers::refused && value.is_object() && outcome.names_members && !outcome.allows_others) {
      for (const auto& [name, member] : value.items())
        if (!outcome.members.contains(name))
          outcome.faults.push_back(at + "/" + name + ": the schema has no such member");
    }
    return outcome;
  }

 private:
  /// One of the schemas that apply to the value.
  [[nodiscard]] Outcome part(const json& schema, const json& value, const std::string& at) const {
    Outcome outcome;
    if (schema.is_boolean()) {
      if (!schema.get<bool>()) outcome.faults.push_back(at + ": nothing is allowed here");
      return outcome;
    }
    for (const auto& [keyword, rule] : schema.items())
      if (std::find(known_keywords.begin(), known_keywords.end(), keyword) == known_keywords.end() &&
          !keyword.starts_with("x-"))
        throw std::logic_error("the validator does not know the keyword " + keyword);
    if (const auto ref = schema.find("$ref"); ref != schema.end())
      outcome.join(part(document_.at(json::json_pointer(ref->get<std::string>().substr(1))), value, at));
    check_value(schema, value, at, outcome);
    if (value.is_number()) check_number(schema, value, at, outcome);
    if (value.is_string()) check_text(schema, value.get<std::string>(), at, outcome);
    if (value.is_array()) check_array(schema, value, at, outcome);
    if (value.is_object()) check_object(schema, value, at, outcome);
    check_alternatives(schema, value, at, outcome);
    return outcome;
  }

  static void check_value(const json& schema, const json& value, const std::string& at, Outcome& outcome) {
    const auto fault = [&](const std::string& what) { outcome.faults.push_back(at + ": " + value.dump() + what); };
    if (const auto rule = schema.find("type"); rule != schema.end()) {
      const auto types =
          rule->is_array() ? rule->get<std::vector<std::string>>() : std::vector{rule->get<std::string>()};
      if (std::none_of(types.begin(), types.end(), [&](const auto& type) { return is_of_type(value, type); }))
        fault(" is not of the type " + rule->dump());
    }
    if (const auto rule = schema.find("const"); rule != schema.end() && *rule != value)
      fault(" is not " + rule->dump());
    if (const auto rule = schema.find("enum"); rule != schema.end())
      if (std::find(rule->begin(), rule->end(), value) == rule->end()) fault(" is none of " + rule->dump());
  }

  static void check_number(const json& schema, const json& value, const std::string& at, Outcome& outcome) {
    const auto number = value.get<double>();
    const auto fault = [&](const char* rule) {
      outcome.faults.push_back(at + ": " + value.dump() + " is against " + rule);
    };
    if (schema.contains("minimum") && number < schema["minimum"].get<double>()) fault("minimum");
    if (schema.contains("maximum") && number > schema["maximum"].get<double>()) fault("maximum");
    if (schema.contains("exclusiveMinimum") && number <= schema["exclusiveMinimum"].get<double>())
      fault("exclusiveMinimum");
  }

  static void check_text(const json& schema, const std::string& text, const std::string& at, Outcome& outcome) {
    const auto fault = [&](const char* rule) {
      outcome.faults.push_back(at + ": \"" + text + "\" is against " + rule);
    };
    if (schema.contains("minLength") && code_points(text) < schema["minLength"].get<std::size_t>()) fault("minLength");
    if (schema.contains("maxLength") && code_points(text) > schema["maxLength"].get<std::size_t>()) fault("maxLength");
    if (schema.contains("pattern") && !is_found(schema["pattern"].get<std::string>(), text)) fault("pattern");
    if (schema.contains("format")) {
      if (schema["format"] != "date-time") throw std::logic_error("the validator does not know this format");
      constexpr const char* date_time = R"(^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?(Z|[+-]\d\d:\d\d)$)";
      if (!is_found(date_time, text)) fault("format date-time");
    }
  }

  void check_array(const json& schema, const json& value, const std::string& at, Outcome& outcome) const {
    if (schema.contains("minItems") && value.size() < schema["minItems"].get<std::size_t>())
      outcome.faults.push_back(at + ": has fewer than minItems");
    if (schema.contains("maxItems") && value.size() > schema["maxItems"].get<std::size_t>())
      outcome.faults.push_back(at + ": has more than maxItems");
    if (!schema.contains("items")) return;
    for (std::size_t i = 0; i < value.size(); ++i)
      take_faults(whole(schema["items"], value[i], at + "/" + std::to_string(i)), outcome);
  }

  void check_object(const json& schema, const json& value, const std::string& at, Outcome& outcome) const {
    if (schema.contains("required"))
      for (const auto& name : schema["required"])
        if (!value.contains(name.get<std::string>()))
          outcome.faults.push_back(at + ": the member " + name.get<std::string>() + " is missing");
    if (schema.contains("propertyNames"))
      for (const auto& [name, member] : value.items())
        take_faults(whole(schema["propertyNames"], name, at + "/" + name), outcome);
    static const json none = json::object();
    const json& properties = schema.contains("properties") ? schema["properties"] : none;
    outcome.names_members |= schema.contains("properties");
    for (const auto& [name, rule] : properties.items()) {
      outcome.members.insert(name);
      if (const auto member = value.find(name); member != value.end())
        take_faults(whole(rule, *member, at + "/" + name), outcome);
    }
    if (!schema.contains("additionalProperties")) return;
    outcome.allows_others = true;
    for (const auto& [name, member] : value.items())
      if (!properties.contains(name))
        take_faults(whole(schema["additionalProperties"], member, at + "/" + name), outcome);
  }

  void check_alternatives(const json& schema, const json& value, const std::string& at, Outcome& outcome) const {
    if (schema.contains("allOf"))
      for (const auto& rule : schema["allOf"]) outcome.join(part(rule, value, at));
    for (const auto* keyword : {"anyOf", "oneOf"}) {
      if (!schema.contains(keyword)) continue;
      std::size_t right = 0;
      std::string why;
      for (const auto& rule : schema[keyword]) {
        auto alternative = part(rule, value, at);
        if (alternative.faults.empty()) {
          ++right;
          outcome.join(std::move(alternative));
        } else {
          why += (why.empty() ? "" : "; or ") + alternative.faults.front();
        }
      }
      if (right == 0) outcome.faults.push_back(at + ": is none of " + keyword + " (" + why + ")");
      if (right > 1 && keyword == std::string_view("oneOf"))
        outcome.faults.push_back(at + ": is more than one of oneOf");
    }
  }

  static void take_faults(const Outcome& from, Outcome& into) {
    into.faults.insert(into.faults.end(), from.faults.begin(), from.faults.end());
  }

  const json& document_;
  UnknownMembers unknown_;
};

}  // namespace

std::vector<std::string> schema_faults(const json& document, const json& schema, const json& value,
                                       UnknownMembers unknown) {
  return Validator(document, unknown).whole(schema, value, "").faults;
}

}  // namespace semblante::test

#include <algorithm>
#include <set>
#include <stdexcept>

#include "server/api/codegen/render.h"

namespace semblante::codegen {
namespace {

struct Texts {
  std::string types, declarations, writers;
};

bool is_null(const Json& schema) { return schema.value("type", Json()) == "null"; }

/// A schema without `null`, and whether it allowed null.
struct Nullable {
  Json schema;
  bool may_be_null = false;
};

Nullable without_null(const Json& schema) {
  Nullable result{schema};
  auto& inner = result.schema;
  if (inner.contains("type") && inner["type"].is_array()) {
    Json types = Json::array();
    for (const auto& type : inner["type"])
      (type == "null" ? result.may_be_null = true : (types.push_back(type), false));
    inner["type"] = types.size() == 1 ? types[0] : types;
  }
  if (inner.contains("enum")) {
    Json words = Json::array();
    for (const auto& word : inner["enum"])
      (word.is_null() ? result.may_be_null = true : (words.push_back(word), false));
    inner["enum"] = words;
  }
  if (inner.contains("anyOf")) {
    Json others = Json::array();
    for (const auto& one : inner["anyOf"]) (is_null(one) ? result.may_be_null = true : (others.push_back(one), false));
    inner["anyOf"] = others;
    if (others.size() == 1 && !inner.contains("x-written-by")) inner = others[0];
  }
  return result;
}

/// Generates the types of all schemas in JSON answers, and their writers.
class Answers {
 public:
  explicit Answers(const Json& document) : document_(document) {
    for (const auto& operation : operations(document)) {
      for (const auto& [status, node] : operation.json->at("responses").items()) {
        const Json& response = follow(document, node);
        const auto content = response.find("content");
        if (status[0] != '2' || content == response.end() || !content->contains("application/json")) continue;
        add_answer(operation, content->at("application/json"));
      }
    }
  }
  [[nodiscard]] const Texts& texts() const { return texts_; }

 private:
  void add_answer(const Operation& operation, const Json& media) {
    if (!media.contains("schema") || media["schema"].contains("x-written-by")) return;
    if (component_name(media["schema"]).empty())
      throw std::runtime_error(operation.function + ": give the schema of the answer a name among the components");
    std::string nested;
    type_of(media["schema"], {}, {}, nested);
  }

  /// The C++ type of a schema. A type without a name of its own is put into `nested`, within `scope`, and named after
  /// `member`.
  std::string type_of(const Json& with_null, const std::string& scope, const std::string& member, std::string& nested) {
    const auto [schema, may_be_null] = without_null(with_null);
    const auto type = plain_type(schema, scope, member, nested);
    return may_be_null ? "std::optional<" + type + ">" : type;
  }

  std::string plain_type(const Json& schema, const std::string& scope, const std::string& member, std::string& nested) {
    if (schema.contains("x-written-by")) return "JsonText";
    if (const auto name = component_name(schema); !name.empty()) return component(name);
    const auto fault = [&](const std::string& what) { return std::runtime_error(scope + "." + member + ": " + what); };
    if (schema.contains("enum") && schema["enum"][0].is_string()) {
      auto name = pascal_case(member);
      nested += words(name, schema["enum"]);
      return name;
    }
    if (schema.contains("enum")) return "double";
    if (schema.contains("allOf")) return structure(pascal_case(member), scope, schema, nested);
    const auto type = schema.value("type", Json());
    if (type == "string") return "std::string";
    if (type == "boolean") return "bool";
    if (type == "number") return "double";
    if (type == "integer") return schema.value("minimum", -1) >= 0 ? "std::uint64_t" : "std::int64_t";
    if (type == "array") return list(schema, scope, member, nested);
    if (type == "object" && schema.contains("properties")) return structure(pascal_case(member), scope, schema, nested);
    if (type == "object" && schema.contains("additionalProperties"))
      return "Members<" + type_of(schema["additionalProperties"], scope, member + "_value", nested) + ">";
    throw fault("there is no C++ type for " + schema.dump());
  }

  std::string list(const Json& schema, const std::string& scope, const std::string& member, std::string& nested) {
    const auto item = type_of(schema.at("items"), scope, member + "_item", nested);
    const auto size = schema.value("maxItems", Json());
    if (item == "double" && !size.is_null() && schema.value("minItems", Json()) == size)
      return "std::array<double, " + size.dump() + ">";
    return "std::vector<" + item + ">";
  }

  std::string component(const std::string& name) {
    const Json& schema = document_.at("components").at("schemas").at(name);
    if (schema.contains("x-written-by")) return "JsonText";
    if (!seen_.insert(name).second) return name;
    std::string text;
    const auto type = plain_type(schema, {}, name, text);
    texts_.types += text;
    if (type != name) texts_.types += "using " + name + " = " + type + ";\n\n";
    return name;
  }

  static std::string words(const std::string& name, const Json& list) {
    std::string text = "struct " + name + "Words {\n  static constexpr auto all = std::to_array<std::string_view>({";
    for (const auto& word : list) text += word.dump() + (word == list.back() ? "" : ", ");
    return text + "});\n};\nusing " + name + " = Word<" + name + "Words>;\n\n";
  }

  std::string structure(const std::string& name, const std::string& scope, const Json& schema, std::string& nested) {
    const auto qualified = scope.empty() ? name : scope + "::" + name;
    std::string inner, fields;
    std::string writer = "Json to_json(const " + qualified + "& answer) {\n  Json json = Json::object();\n";
    add_members(schema, qualified, inner, fields, writer);
    texts_.declarations += "Json to_json(const " + qualified + "& answer);\n";
    if (fields.empty()) writer.replace(writer.find("const "), 0, "[[maybe_unused]] ");
    texts_.writers += writer + "  return json;\n}\n\n";
    nested += "struct " + name + " {\n" + inner + fields + "};\n\n";
    return name;
  }

  void add_members(const Json& schema, const std::string& scope, std::string& inner, std::string& fields,
                   std::string& writer) {
    if (const auto name = component_name(schema); !name.empty()) {
      fields += component(name) + " " + snake_case(name) + ";  ///< its members are members of this\n";
      writer += "  merge(json, answer." + snake_case(name) + ");\n";
      return;
    }
    for (const auto& part : schema.value("allOf", Json::array())) add_members(part, scope, inner, fields, writer);
    const Json properties = schema.value("properties", Json::object());
    for (const auto& [name, rule] : properties.items())
      add_member(name, rule, is_required(schema, name), scope, inner, fields, writer);
  }

  void add_member(const std::string& name, const Json& rule, bool required, const std::string& scope,
                  std::string& inner, std::string& fields, std::string& writer) {
    const auto key = "json[" + quoted(name) + "] = ";
    if (rule.contains("const")) {
      writer += "  " + key + rule["const"].dump() + ";\n";
      return;
    }
    const auto type = type_of(rule, scope, name, inner);
    if (const auto words = rule.value("description", std::string()); !words.empty()) fields += "/// " + words + "\n";
    if (required) {
      fields += type + " " + name + ";\n";
      writer += "  " + key + "value_to_json(answer." + name + ");\n";
      return;
    }
    if (type.starts_with("std::optional"))
      throw std::runtime_error(scope + "." + name + ": an answer's member may be null or left out, not both");
    fields += "std::optional<" + type + "> " + name + " = std::nullopt;  ///< may be left out\n";
    writer += "  if (answer." + name + ") " + key + "value_to_json(*answer." + name + ");\n";
  }

  static bool is_required(const Json& schema, const std::string& name) {
    const auto required = schema.value("required", Json::array());
    return std::find(required.begin(), required.end(), name) != required.end();
  }

  const Json& document_;
  std::set<std::string> seen_;
  Texts texts_;
};

}  // namespace

std::string render_answers_header(const Json& document) {
  const Answers answers(document);
  return generated_notice() +
         "#pragma once\n\n#include \"server/api/answer_types.h\"\n\n"
         "/// The bodies of JSON answers, by the name of their schema. To be filled by designated initializers: what "
         "is\n"
         "/// required and left out is then a warning, and warnings are errors.\nnamespace semblante::api::answer "
         "{\n\n" +
         answers.texts().types + answers.texts().declarations + "\n}  // namespace semblante::api::answer\n";
}

std::string render_answers_source(const Json& document) {
  return generated_notice() +
         "#include \"server/api/generated/answers.h\"\n\n#include \"server/api/write_answer.h\"\n\n"
         "namespace semblante::api::answer {\n\n" +
         Answers(document).texts().writers + "}  // namespace semblante::api::answer\n";
}

}  // namespace semblante::codegen

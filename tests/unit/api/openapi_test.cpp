// The API document against the table of routes, and every JSON file that is published: what needs no server to be seen.

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/import/model_formats.h"
#include "core/json/read_json.h"
#include "core/types/advice.h"
#include "server/api/documents.h"
#include "server/api/routes.h"
#include "server/http/media_type.h"

namespace semblante::api {
namespace {

using nlohmann::json;

const json& document() {
  static const json parsed = [] {
    const auto read = read_json(openapi_document());
    return read ? *read : json::object();
  }();
  return parsed;
}

const json& operation_of(const Route& route) {
  std::string method(route.method);
  for (char& c : method) c = static_cast<char>(std::tolower(c));
  return document().at("paths").at(std::string(route.pattern)).at(method);
}

/// The parameters of an operation, references followed.
std::vector<json> parameters_of(const json& operation) {
  std::vector<json> list = operation.value("parameters", std::vector<json>());
  for (json& parameter : list)
    if (parameter.contains("$ref"))
      parameter = document().at(json::json_pointer(parameter["$ref"].get<std::string>().substr(1)));
  return list;
}

/// The names in braces of a pattern.
std::vector<std::string> names_in(std::string_view pattern) {
  std::vector<std::string> names;
  for (std::size_t at = 0; (at = pattern.find('{', at)) != std::string_view::npos; ++at)
    names.emplace_back(pattern.substr(at + 1, pattern.find('}', at) - at - 1));
  return names;
}

TEST(OpenApi, UploadOfAHead_NamesTheFormatsThereAre) {
  const json& body = document().at("paths").at("/v1/models").at("post").at("requestBody");
  const auto description = body.at("description").get<std::string>();
  for (const ModelFile& file : model_files) {
    EXPECT_TRUE(body.at("content").contains(std::string(file.media_type))) << file.media_type;
    EXPECT_NE(description.find(file.title), std::string::npos) << file.title;
  }
  for (const auto type : other_model_media_types) EXPECT_TRUE(body.at("content").contains(std::string(type))) << type;
  EXPECT_TRUE(body.at("content").contains("multipart/form-data"));
  std::set<std::string_view> media_types(other_model_media_types.begin(), other_model_media_types.end());
  for (const ModelFile& file : model_files) media_types.insert(file.media_type);
  EXPECT_EQ(body.at("content").size(), media_types.size() + 1);
}

/// The files of a folder of pages have their types from a table of server/http, which does not depend on core/import.
TEST(OpenApi, ModelFilesAmongPages_HaveTheTypesOfUploads) {
  EXPECT_EQ(http::media_type_of_file("face.glb"), glb_media_type);
  for (const ModelFile& file : model_files) {
    const auto served = http::media_type_of_file("head" + std::string(file.ending));
    if (served != "application/octet-stream") {
      EXPECT_EQ(served, file.media_type) << file.ending;
    }
  }
}

TEST(OpenApi, Advice_IsThatOfTheErrors) {
  std::vector<std::string> names;
  for (const auto& text : all_advice()) names.emplace_back(text.name);
  EXPECT_EQ(document().at("components").at("schemas").at("Advice").at("enum").get<std::vector<std::string>>(), names);
}

TEST(OpenApi, NoObject_NamesAMemberTwice) {
  const auto read = read_json(openapi_document());
  ASSERT_TRUE(read) << read.error().where << ": " << read.error().message;
}

TEST(PublishedJson, NoObject_NamesAMemberTwice) {
  namespace fs = std::filesystem;
  std::size_t files = 0;
  for (const char* const folder : {"protocol", "server", "core", "clients"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SEMBLANTE_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".json") continue;
      std::ifstream stream(entry.path(), std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
      const auto read = read_json(text);
      EXPECT_TRUE(read) << entry.path() << ": " << read.error().where << ": " << read.error().message;
      ++files;
    }
  }
  EXPECT_GT(files, 40U) << "the folders are where they were";
}

TEST(OpenApi, PathParameters_AreThoseOfThePath) {
  for (const Route& route : routes()) {
    std::vector<std::string> declared;
    for (const json& parameter : parameters_of(operation_of(route))) {
      if (parameter.at("in") != "path") continue;
      declared.push_back(parameter.at("name"));
      EXPECT_EQ(parameter.value("required", false), true) << route.pattern;
    }
    EXPECT_THAT(declared, ::testing::UnorderedElementsAreArray(names_in(route.pattern))) << route.pattern;
  }
}

TEST(OpenApi, Bodies_HaveTheirAnswers) {
  for (const Route& route : routes()) {
    SCOPED_TRACE(std::string(route.method) + " " + std::string(route.pattern));
    const json& responses = operation_of(route).at("responses");
    if (route.body.kind == BodyKind::none) continue;
    // Whatever the body, it can be too large and of a type that is not read.
    EXPECT_TRUE(responses.contains("413"));
    EXPECT_TRUE(responses.contains("415"));
    // Stopping a recording reads its body away and says nothing of it.
    EXPECT_EQ(responses.contains("400"), route.pattern != "/v1/recordings/{recording}/stop")
        << "a body may be malformed";
    const bool may_be_form = route.pattern == "/v1/expressions" || route.pattern == "/v1/speeches";
    const bool may_be_absent = route.body.kind == BodyKind::json && route.method == "POST" && !may_be_form;
    EXPECT_EQ(route.body.announced, !may_be_absent);
  }
}

TEST(OpenApi, StorageProblems_AreStatedWhereTheyCanHappen) {
  for (const Route& route : routes()) {
    SCOPED_TRACE(std::string(route.method) + " " + std::string(route.pattern));
    const json& responses = operation_of(route).at("responses");
    // Frames, what plays, sessions and tickets are in memory only.
    const bool is_live = route.pattern == "/v1/streams/{stream}/frames" ||
                         route.pattern == "/v1/streams/{stream}/performances/{performance}" ||
                         route.pattern == "/v1/session" || route.pattern == "/v1/tickets";
    if (route.method != "GET" && !is_live) {
      EXPECT_TRUE(responses.contains("507")) << "what needs room is refused while there is none";
    }
    const bool in_store = route.pattern.starts_with("/v1/models") || route.pattern.starts_with("/v1/jobs") ||
                          route.pattern.starts_with("/v1/expressions") || route.pattern.starts_with("/v1/recordings");
    if (in_store || responses.contains("507")) {
      EXPECT_TRUE(responses.contains("503"));
    }
  }
}

TEST(OpenApi, Parameters_HaveTheirAnswers) {
  const std::map<std::string, std::vector<std::string>> answers = {{"If-Match", {"412"}},
                                                                   {"If-None-Match", {"304"}},
                                                                   {"Range", {"206", "416"}},
                                                                   {"limit", {"400"}},
                                                                   {"Idempotency-Key", {"400", "409", "422"}}};
  for (const Route& route : routes()) {
    SCOPED_TRACE(std::string(route.method) + " " + std::string(route.pattern));
    const json& responses = operation_of(route).at("responses");
    std::set<std::string> declared;
    for (const json& parameter : parameters_of(operation_of(route))) {
      declared.insert(parameter.at("name"));
      const auto found = answers.find(parameter.at("name"));
      if (found == answers.end()) continue;
      for (const auto& status : found->second) EXPECT_TRUE(responses.contains(status)) << found->first << " " << status;
    }
    EXPECT_EQ(responses.contains("304"), declared.contains("If-None-Match"));
    EXPECT_EQ(responses.contains("206"), declared.contains("Range"));
  }
}

TEST(OpenApi, OperationIds_AreThereAndDiffer) {
  std::set<std::string> ids;
  for (const Route& route : routes()) EXPECT_TRUE(ids.insert(operation_of(route).at("operationId")).second);
}

}  // namespace
}  // namespace semblante::api

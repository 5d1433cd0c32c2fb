#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "server/api/generated/answers.h"
#include "server/http/message.h"
#include "server/store/records.h"
#include "server/streams/stream.h"

// Records as clients see them: each as the struct that is generated from its schema in openapi.json. nlohmann's types
// stay inside the sources of this folder.
namespace semblante::api {

/// The JSON of request bodies: lookup in logarithmic time.
using JsonBody = nlohmann::json;

/// True for the four artefacts that a client fetches to animate a face.
bool is_of_package(std::string_view name);

answer::Model represent(const store::ModelRecord& model, const std::vector<store::ArtefactRecord>& artefacts);
answer::Job represent(const store::JobRecord& job);
answer::Stream represent(const streams::StreamInfo& stream);
answer::Playing represent(const streams::PlayStatus& playing);
/// All members except the displacements.
answer::Expression represent(const store::SetRecord& set);

std::string model_etag(const store::ModelRecord& model);
std::string set_etag(const store::SetRecord& set);
std::string points_etag(const store::ModelRecord& model);

/// A response with JSON, not cached. Invalid UTF-8 is replaced and not refused, because it comes from uploaded files.
http::Response json_response(int status, const Json& json);
template <class Answer>
http::Response json_response(int status, const Answer& answer) {
  return json_response(status, to_json(answer));
}

/// nullopt for an empty text, which means "none" in records.
inline std::optional<std::string> text_or_null(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}
inline std::optional<answer::JsonText> json_or_null(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(answer::JsonText{text});
}

}  // namespace semblante::api

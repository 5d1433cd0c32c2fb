#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "server/http/message.h"
#include "server/store/records.h"
#include "server/streams/stream.h"

// How records look to clients. nlohmann's types stay inside the sources of this folder.
namespace semblante::api {

/// What is answered: members in the order they are put in. Finding one takes time linear in their number.
using Json = nlohmann::ordered_json;
/// What came from outside: found by name in logarithmic time.
using JsonBody = nlohmann::json;

/// One of the four artefacts that a client fetches to animate a face.
bool is_of_package(std::string_view name);

Json represent(const store::ModelRecord& model, const std::vector<store::ArtefactRecord>& artefacts);
Json represent(const store::JobRecord& job);
Json represent(const streams::StreamInfo& stream);
Json represent(const streams::PlayStatus& playing);
/// All but the displacements.
Json represent(const store::SetRecord& set);

std::string model_etag(const store::ModelRecord& model);
std::string set_etag(const store::SetRecord& set);
std::string points_etag(const store::ModelRecord& model);

/// JSON with its media type, not cached. Text that is not UTF-8 is repaired rather than refused: it came from a file.
http::Response json_response(int status, const Json& json);

}  // namespace semblante::api

#pragma once

#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "core/json/json_tree.h"
#include "core/json/json_view.h"
#include "core/types/result.h"

namespace semblante {

/// read_json_tree() as nlohmann's document, for callers that change it or write it again.
Result<nlohmann::json> read_json(std::string_view text, const JsonLimits& limits = {});

/// Like read_json(), for a text that must be an object.
Result<nlohmann::json> read_json_object(std::string_view text, const JsonLimits& limits = {});

/// A view of such a document, for JsonCursor.
JsonView json_view(const nlohmann::json& value);

}  // namespace semblante

#pragma once

#include <string_view>

/// Files of the source tree that the server sends as they are. They are embedded at compile time, so that the server
/// needs no files beside itself.
namespace semblante::api {

/// openapi.json of this folder.
std::string_view openapi_document();

/// protocol/SPEC.md.
std::string_view protocol_specification();

/// protocol/schema/packed_tables.json.
std::string_view packed_tables_document();

}  // namespace semblante::api

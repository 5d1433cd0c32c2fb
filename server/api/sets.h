#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/extract/named_set.h"
#include "server/api/representations.h"
#include "server/http/message.h"
#include "server/store/records.h"

namespace semblante::api {

struct Context;

/// Finds a set of the library by its name, which is also its id: the ids of other sets are longer.
std::optional<NamedSet> find_built_in(std::string_view name);

/// Parses a stored set, which was checked before it was stored.
NamedSet read_set(const store::SetRecord& record);

/// The request's body as a set: {"name", "kind", "displacements"}. The other members of a GET answer are ignored, so
/// that an answer can be edited and sent back. Refuses with the pointer of the error.
NamedSet set_from_body(const http::Request& request);

/// 201 (or another status) with the whole set.
http::Response new_set_response(const store::SetRecord& set, int status);

/// Reads "expressions" of a PATCH of a model: {"joy": "<id of a set>", "a": null}, null for the library's set. Refuses,
/// with the pointer, an unknown slot (or that of silence or "none"), an unknown set, and a set of the other kind.
std::vector<store::WornSet> worn_from_json(Context& context, const JsonBody& changes);

/// A parametrization job that makes a model's package again, with the options of the existing package or of the running
/// job; nullopt without a package and a running job.
std::optional<store::JobRecord> make_package_again(Context& context, const store::ModelRecord& model);

}  // namespace semblante::api

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

/// A set of the library by its name, which is its id too: the ids of others are longer.
std::optional<NamedSet> find_built_in(std::string_view name);

/// A stored set as it was checked when it came.
NamedSet read_set(const store::SetRecord& record);

/// The request's body as a set that somebody made: {"name", "kind", "displacements"}. What a GET gives beside these is
/// read over, so that it can be edited and sent back. Refuses with the pointer of what is wrong.
NamedSet set_from_body(const http::Request& request);

/// 201 (or another status) with the whole set.
http::Response new_set_response(const store::SetRecord& set, int status);

/// What a PATCH of a model says of its expressions: {"joy": "<id of a set>", "a": null}, null for the library's own.
/// Refuses by pointer: a slot that is none (or at rest), a set that is not there, or one of the other kind.
std::vector<store::WornSet> worn_from_json(Context& context, const JsonBody& changes);

/// The parametrization that makes a model's package again with the options it was made with, or those it is being made
/// with; none where there is no package and none to come.
std::optional<store::JobRecord> make_package_again(Context& context, const store::ModelRecord& model);

}  // namespace semblante::api

#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "server/api/api.h"
#include "server/api/representations.h"
#include "server/http/problem.h"

namespace semblante::api {

/// Carries a problem out of the middle of a handler; Api::handle turns it into the answer.
struct Refused {
  http::Problem problem;
  unsigned retry_after = 0;  ///< seconds, for Retry-After; 0: says nothing of it
};
[[noreturn]] void refuse(std::string_view slug, std::string detail, std::string pointer = {});
/// 429: the same may be asked again after so many seconds.
[[noreturn]] void refuse_for_now(std::string detail, unsigned retry_after);

/// The model of the path; refuses with 404.
store::ModelRecord model_of(Context& context, const http::Request& request);

/// The body as a JSON object; an absent body is an empty object. Refuses with 400 (`malformed-request`, with the byte,
/// or with the pointer of a member named twice or of a value over a limit) or 422 when it is no object.
JsonBody body_object(const http::Request& request);

/// Refuses members of `object` that are none of `known` (generated/body_members.h), by pointer.
void refuse_unknown_members(const JsonBody& object, std::span<const std::string_view> known);

/// Names that clients give: of models, recordings, sets, points.
inline constexpr std::size_t max_name_bytes = 200;

/// A string of 1..max bytes without control characters; `pointer` is where it was.
std::string checked_text(const JsonBody& value, std::size_t max, const std::string& pointer);
std::string checked_text(std::string_view value, std::size_t max, const std::string& pointer);

/// Refuses with 412 when the request's If-Match does not name the tag.
void check_if_match(const http::Request& request, const std::string& etag);

/// The request's Idempotency-Key. `earlier`: what it made the first time. Refuses a key that is too long, or was used
/// for a different request. Of requests with one key at the same moment one at a time gets past this: the handler
/// keeps the check until it has created or failed, and the next one sees what became of it.
struct IdempotencyCheck {
  std::optional<store::IdempotencyRecord> record;  ///< to be stored with what is made; `resource` to be filled in
  std::optional<std::string> earlier;
  std::optional<KeyLocks::Held> held;
};
IdempotencyCheck check_idempotency(Context& context, const http::Request& request, std::string_view body_hash);

/// `?limit=` of a list: 50 unless told, at most 200.
std::size_t page_size(const http::Request& request);

/// Cuts records that were asked for with one more than a page has to the page. Gives where the next one begins.
template <class Record>
std::optional<std::string> cut_to_page(std::vector<Record>& records, std::size_t limit) {
  if (records.size() <= limit) return std::nullopt;
  records.resize(limit);
  return records.back().id;
}

/// The last segment of a path of any system, without what a file name cannot hold; at most 200 bytes.
std::string clean_file_name(std::string_view name);

/// 202 with a job.
http::Response accepted(const store::JobRecord& job);
/// Refuses with 429 when no more jobs may wait.
void refuse_unless_room(const jobs::JobQueue& jobs);

/// Refuses with 409 a model whose vertices are not known.
void refuse_unless_imported(const store::ModelRecord& model);

}  // namespace semblante::api

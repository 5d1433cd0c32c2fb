#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "server/api/api.h"
#include "server/api/representations.h"
#include "server/http/problem.h"

namespace semblante::api {

/// An exception with a problem document; Api::handle turns it into the answer.
struct Refused {
  http::Problem problem;
  unsigned retry_after = 0;  ///< seconds, for Retry-After; 0: no such header
};
[[noreturn]] void refuse(std::string_view slug, std::string detail, std::string pointer = {});
/// The problem's usual advice is replaced by `advice`, or left out.
[[noreturn]] void refuse(std::string_view slug, std::string detail, std::string pointer, std::optional<Advice> advice);
/// Refuses with 429 and a Retry-After of so many seconds.
[[noreturn]] void refuse_for_now(std::string detail, unsigned retry_after);

/// A slot of context.exports; refuses with 429 when all are taken.
std::unique_ptr<void, void (*)(void*)> export_slot(Context& context);

/// The model in the request's path; refuses with 404.
store::ModelRecord model_of(Context& context, const http::Request& request);

/// The body as a JSON object; an absent body is an empty object. Refuses with 400 (`malformed-request`, with the byte,
/// or with the pointer of a member named twice or of a value over a limit) or 422 when it is no object.
JsonBody body_object(const http::Request& request);

/// Refuses members of `object` that are not in `known` (generated/body_members.h), with their pointer.
void refuse_unknown_members(const JsonBody& object, std::span<const std::string_view> known);

/// Limit of the names that clients choose: of models, recordings, sets, points.
inline constexpr std::size_t max_name_bytes = 200;

/// A string of 1..max bytes without control characters; `pointer` is its place in the body.
std::string checked_text(const JsonBody& value, std::size_t max, const std::string& pointer);
std::string checked_text(std::string_view value, std::size_t max, const std::string& pointer);

/// A member that is true or false; false without it.
bool flag_member(const JsonBody& body, const char* name);
/// A member that is a number from `least` to `most`; `otherwise` without it.
double number_or(const JsonBody& body, const char* name, double otherwise, double least, double most);

/// Refuses with 412 when the request's If-Match does not contain the tag.
void check_if_match(const http::Request& request, const std::string& etag);

/// The request's Idempotency-Key. `earlier`: what the first request with this key created. Refuses a key that is too
/// long or was used for a different request. Concurrent requests with one key pass one at a time: the handler holds the
/// check until it has created or failed, and the next request sees the result.
struct IdempotencyCheck {
  std::optional<store::IdempotencyRecord> record;  ///< to be stored with the created resource, after setting `resource`
  std::optional<std::string> earlier;
  std::optional<KeyLocks::Held> held;
};
IdempotencyCheck check_idempotency(Context& context, const http::Request& request, std::string_view body_hash);

/// Requests that create or remove a stream, or begin what ends with it, pass one at a time for each stream: it is in
/// two places, the store and the hub. Two of them at once could leave it in one: gone after the next start, or a name
/// that is taken by what nobody can remove. Taken after an Idempotency-Key is checked and before take_quota().
KeyLocks::Held take_stream_turn(Context& context, const std::string& id);

/// `?limit=` of a list: default 50, at most 200.
std::size_t page_size(const http::Request& request);

/// Truncates records, queried with one more than the page size, to one page. Returns the cursor of the next page.
template <class Record>
std::optional<std::string> cut_to_page(std::vector<Record>& records, std::size_t limit) {
  if (records.size() <= limit) return std::nullopt;
  records.resize(limit);
  return records.back().id;
}

/// The last segment of a path of any operating system, without what has_controls() of core/types looks for; at most 200
/// bytes.
std::string clean_file_name(std::string_view name);

/// Whose request this is, for the records that it makes.
store::Origin origin_of(const http::Request& request);

/// 202 with a job.
http::Response accepted(const store::JobRecord& job);
/// Refuses with 429 when the job queue is full.
void refuse_unless_room(const jobs::JobQueue& jobs);

/// Refuses with 409 a model that is not imported.
void refuse_unless_imported(const store::ModelRecord& model);

}  // namespace semblante::api

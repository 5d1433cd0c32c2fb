#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "server/api/api.h"
#include "server/store/owner_store.h"

namespace semblante::api {

/// One limit of a token, with what is used of it.
struct Quota {
  std::string_view name;  ///< in answers and messages: "bytes"
  std::uint64_t used = 0;
  std::optional<std::uint64_t> limit;  ///< empty: no limit
};

/// Part of a limit from which on answers warn.
inline constexpr double quota_warning = 0.8;

/// "ok", "warning" or "full".
std::string_view level_of(const Quota& quota);

/// The token whose limits apply to a request; empty: none do, on a server without tokens and for the scope admin.
std::string limited_token(const http::Request& request);
/// To be held from the check of a limit until what was checked is stored, so that requests at the same time cannot
/// exceed it together.
using QuotaTurn = std::optional<KeyLocks::Held>;

/// Refuses with `quota-exceeded` (507), or for jobs with 429, what would exceed a limit of the requester's token. What
/// comes near to one is told in the answer's header X-Quota-Warning. Counts as one creation of the requester's address,
/// with a token or without, and refuses (429) what exceeds their rate. A job whose results are kept needs one byte: how
/// many it makes is not known before, so a job that was accepted may exceed the limit by its results.
[[nodiscard]] QuotaTurn take_quota(Context& context, http::Request& request, const store::Usage& more);

/// Whether the recordings of a token may go on; to be asked while one runs. Empty: always.
std::function<bool()> recording_room(Context& context, const http::Request& request);

/// What a body holds while it arrives and is handled, or the answer to a token that sends as many as it may. Does not
/// wait.
std::variant<std::shared_ptr<const void>, http::Response> take_upload(const Security& security,
                                                                      const http::Request& head);

/// Adds X-Quota-Warning to the answer of a request that take_quota() has seen.
void tell_quota(const http::Request& request, http::Response& response);

}  // namespace semblante::api

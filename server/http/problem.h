#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/types/advice.h"
#include "core/types/result.h"
#include "server/http/message.h"

namespace semblante::http {

/// One of several errors of the same request.
struct Fault {
  std::string pointer;  ///< JSON pointer into the body, or "?name" for a query parameter
  std::string detail;
};

/// A limit that a request would exceed.
struct ReachedLimit {
  std::string name;
  std::uint64_t value = 0, used = 0;

  bool operator==(const ReachedLimit&) const = default;
};

/// An RFC 9457 problem document as plain values. `slug` is the stable end of its `type`: "/problems/<slug>".
struct Problem {
  int status = 500;
  std::string slug = "internal";
  std::string title;
  std::string detail;
  std::string pointer;        ///< the invalid field; may be empty
  std::vector<Fault> faults;  ///< all errors, when there is more than one
  std::optional<ReachedLimit> limit = std::nullopt;
  std::optional<Advice> advice = std::nullopt;  ///< what helps, as far as it is known

  bool operator==(const Problem&) const = default;
};
inline bool operator==(const Fault& a, const Fault& b) { return a.pointer == b.pointer && a.detail == b.detail; }

/// The problem with this stable slug; status, title and what usually helps come from the table of slugs (README.md).
/// The slug must be known.
Problem make_problem(std::string_view slug, std::string detail, std::string pointer = {});

/// The problem document for an error of the core; the code selects the slug, and the advice if the error has none.
Problem problem_from(const Error& error);

/// The document as JSON text: stored with a failed job or model and shown inside them.
std::string to_json(const Problem& problem);
/// The reverse of to_json; a problem "internal" when the text is not a problem document.
Problem problem_from_json(std::string_view text);

/// The whole answer, with its media type.
Response to_response(const Problem& problem);
/// Adds the member `request` to an answer that to_response() has made; other answers stay as they are.
void add_request_id(Response& response, std::string_view id);

/// Every slug with its status and title; iterated by the documentation and the tests.
struct ProblemKind {
  std::string_view slug;
  int status;
  std::string_view title;
  std::optional<Advice> advice;  ///< what usually helps
};
std::vector<ProblemKind> problem_kinds();

}  // namespace semblante::http

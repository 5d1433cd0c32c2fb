#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/types/result.h"
#include "server/http/message.h"

namespace semblante::http {

/// One of several faults of the same request.
struct Fault {
  std::string pointer;  ///< JSON pointer into the body, or "?name" for a query parameter
  std::string detail;
};

/// An RFC 9457 problem document as plain values. `slug` is the stable end of its `type`: "/problems/<slug>".
struct Problem {
  int status = 500;
  std::string slug = "internal";
  std::string title;
  std::string detail;
  std::string pointer;        ///< the field that is wrong; may be empty
  std::vector<Fault> faults;  ///< all of them, when there is more than one

  bool operator==(const Problem&) const = default;
};
inline bool operator==(const Fault& a, const Fault& b) { return a.pointer == b.pointer && a.detail == b.detail; }

/// The problem with this stable slug; status and title come from the table of slugs (README.md). The slug must be
/// known.
Problem make_problem(std::string_view slug, std::string detail, std::string pointer = {});

/// What the core said about other people's bytes, as a problem: the code picks the slug.
Problem problem_from(const Error& error);

/// The document alone, as JSON text: stored with a failed job or model and shown inside them.
std::string to_json(const Problem& problem);
/// Reads back what to_json wrote; a problem "internal" when the text is not one.
Problem problem_from_json(std::string_view text);

/// The whole answer, with its media type.
Response to_response(const Problem& problem);

/// Every slug with its status and title: what the documentation and the tests walk.
struct ProblemKind {
  std::string_view slug;
  int status;
  std::string_view title;
};
std::vector<ProblemKind> problem_kinds();

}  // namespace semblante::http

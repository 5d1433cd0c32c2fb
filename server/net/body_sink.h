#pragma once

// Private to net/.

#include <cstdint>
#include <optional>
#include <string_view>

#include "server/http/application.h"
#include "server/http/problem.h"
#include "server/net/body_file.h"
#include "server/net/state.h"

namespace semblante::net {

/// Stores the body of a request while it arrives: in the request's memory, or in a temporary file. Both must outlive
/// this object.
class BodySink {
 public:
  BodySink(const http::BodyPlan& plan, SharedState& state, http::Request& request);
  BodySink(const BodySink&) = delete;
  BodySink& operator=(const BodySink&) = delete;

  /// The problem, if `size` further bytes are too many: known before they come.
  [[nodiscard]] std::optional<http::Problem> announce(std::uint64_t size) const;
  /// The problem, if this piece cannot be stored: `content-too-large`, `overloaded`, or that of
  /// Application::unwritten_body.
  [[nodiscard]] std::optional<http::Problem> append(std::string_view piece);

  static http::Problem too_large(const http::BodyPlan& plan);

 private:
  http::Problem unwritten(int error_number);

  const http::BodyPlan& plan_;
  http::Request& request_;
  http::Application& application_;
  std::optional<BodyFile> file_;  ///< of a body on disk
};

}  // namespace semblante::net

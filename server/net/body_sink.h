#pragma once

// Private to net/.

#include <optional>
#include <string_view>

#include "server/http/application.h"
#include "server/http/problem.h"
#include "server/net/state.h"

namespace semblante::net {

/// Where the body of a request goes while it arrives: into the request's memory, or into a file of its own. Both are
/// referred to, and outlive this.
class BodySink {
 public:
  BodySink(const http::BodyPlan& plan, SharedState& state, http::Request& request);
  ~BodySink();
  BodySink(const BodySink&) = delete;
  BodySink& operator=(const BodySink&) = delete;

  /// The problem, if this piece cannot be taken: `content-too-large`, or what the application says of a
  /// file that cannot be written.
  [[nodiscard]] std::optional<http::Problem> append(std::string_view piece);

  static http::Problem too_large(const http::BodyPlan& plan);

 private:
  const http::BodyPlan& plan_;
  http::Request& request_;
  http::Application& application_;
  int descriptor_ = -1, open_error_ = 0;
};

}  // namespace semblante::net

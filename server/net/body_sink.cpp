#include "server/net/body_sink.h"

#include <cerrno>
#include <fcntl.h>
#include <string>
#include <unistd.h>

#include "server/log/log.h"

namespace semblante::net {

BodySink::BodySink(const http::BodyPlan& plan, SharedState& state, http::Request& request)
    : plan_(plan), request_(request), application_(state.application) {
  if (!plan.to_file) return;
  const auto name = "upload-" + std::to_string(::getpid()) + "-" + std::to_string(state.upload_number++);
  request.body_file = std::make_shared<http::TemporaryFile>(state.config.upload_directory / name);
  file_.emplace(state, request.body_file->path(), O_WRONLY | O_CREAT | O_EXCL);
}

std::optional<http::Problem> BodySink::announce(std::uint64_t size) const {
  if (size > plan_.max_bytes - request_.body_size) return too_large(plan_);
  return std::nullopt;
}

std::optional<http::Problem> BodySink::append(std::string_view piece) {
  request_.body_size += piece.size();
  if (request_.body_size > plan_.max_bytes) return too_large(plan_);
  if (!plan_.to_file) {
    request_.body.append(piece);
    return std::nullopt;
  }
  if (file_->is_over_limit()) return http::make_problem("overloaded", "too many files are being sent; try again later");
  while (!piece.empty()) {
    if (file_->descriptor() < 0) return unwritten(file_->error());
    const auto written = ::write(file_->descriptor(), piece.data(), piece.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return unwritten(errno);
    piece.remove_prefix(static_cast<std::size_t>(written));
  }
  return std::nullopt;
}

http::Problem BodySink::unwritten(int error_number) {
  const log::Scope scope({.request = request_.id});
  return application_.unwritten_body(error_number);
}

http::Problem BodySink::too_large(const http::BodyPlan& plan) {
  auto problem =
      http::make_problem("content-too-large", "at most " + std::to_string(plan.max_bytes) + " bytes are accepted here");
  problem.advice = plan.if_too_large;
  return problem;
}

}  // namespace semblante::net

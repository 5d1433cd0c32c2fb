#include "server/api/motion_body.h"

#include <fstream>
#include <iterator>
#include <utility>

#include "protocol/cpp/performance_document.h"
#include "server/api/common.h"

namespace semblante::api {

std::string text_of_body(const http::Request& request) {
  if (!request.body_file) return request.body;
  std::ifstream file(request.body_file->path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void refuse_performance(const Error& error) {
  if (error.code == ErrorCode::too_large) refuse("content-too-large", error.message, error.where);
  const bool no_json = error.code == ErrorCode::malformed && error.where.empty();
  refuse(no_json ? "malformed-request" : "invalid-performance", error.message, error.where);
}

void refuse_fap_file(const Error& error) {
  refuse(error.code == ErrorCode::too_large ? "content-too-large" : "invalid-fap-file", error.message, error.where);
}

Performance performance_of_body(const http::Request& request) {
  const auto script = read_performance(text_of_body(request));
  if (!script) refuse_performance(script.error());
  auto performance = Performance::compile(*script);
  if (!performance) refuse_performance(performance.error());
  return std::move(*performance);
}

FapFileReading fap_file_of_body(const http::Request& request) {
  FapFileLimits limits;
  limits.bytes = max_fap_body_bytes;
  auto reading = read_fap_file(text_of_body(request), limits);
  if (!reading) refuse_fap_file(reading.error());
  return std::move(*reading);
}

}  // namespace semblante::api

#include "server/http/conditional.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "server/http/media_type.h"
#include "server/http/problem.h"

namespace semblante::http {
namespace {

struct ByteRange {
  std::uint64_t first, last;
};

std::optional<std::uint64_t> number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

enum class RangeKind { none, satisfiable, outside };

/// A Range that is not of the form `bytes=a-b` is ignored, as the RFC requires.
RangeKind parse_range(std::string_view value, std::uint64_t size, ByteRange& out) {
  constexpr std::string_view unit = "bytes=";
  if (value.substr(0, unit.size()) != unit) return RangeKind::none;
  value.remove_prefix(unit.size());
  const auto dash = value.find('-');
  if (dash == std::string_view::npos || value.find(',') != std::string_view::npos) return RangeKind::none;
  const auto first = value.substr(0, dash);
  const auto last = value.substr(dash + 1);
  if (first.empty()) {  // the last n bytes
    const auto count = number(last);
    if (!count) return RangeKind::none;
    if (*count == 0 || size == 0) return RangeKind::outside;
    out = {size - std::min(*count, size), size - 1};
    return RangeKind::satisfiable;
  }
  const auto from = number(first);
  const auto to = last.empty() ? std::optional<std::uint64_t>(size) : number(last);
  if (!from || !to || *to < *from) return from && to && last.empty() ? RangeKind::outside : RangeKind::none;
  if (*from >= size) return RangeKind::outside;
  out = {*from, std::min(*to, size - 1)};
  return RangeKind::satisfiable;
}

Response not_modified(const Response& full) {
  Response response;
  response.status = 304;
  for (const auto* name : {"ETag", "Cache-Control", "Vary", "Content-Location"})
    if (const auto found = full.headers.find(name); found != full.headers.end()) response.headers.insert(*found);
  return response;
}

}  // namespace

bool etag_matches(std::string_view list, std::string_view etag, bool weak) {
  for (const auto& item : split_list(list)) {
    std::string_view tag = item;
    if (tag == "*") return true;
    if (tag.substr(0, 2) == "W/") {
      if (!weak) continue;
      tag.remove_prefix(2);
    }
    if (tag == etag) return true;
  }
  return false;
}

Response apply_preconditions(const Request& request, Response response) {
  const auto etag_field = response.headers.find("ETag");
  if (response.status != 200 || etag_field == response.headers.end()) return response;
  const std::string& etag = etag_field->second;
  if (const auto match = request.header("If-Match"); match && !etag_matches(*match, etag, false))
    return to_response(make_problem("precondition-failed", "the ETag of the resource is " + etag));
  if (const auto none = request.header("If-None-Match"); none && etag_matches(*none, etag, true))
    return not_modified(response);
  return response;
}

Response apply_conditions(const Request& request, Response full) {
  auto response = apply_preconditions(request, std::move(full));
  const auto etag = response.headers.find("ETag");
  if (response.status != 200 || etag == response.headers.end()) return response;
  const bool sized =
      std::holds_alternative<FileBody>(response.body) || std::holds_alternative<std::string>(response.body);
  if (!sized) return response;
  response.headers["Accept-Ranges"] = "bytes";
  const auto range = request.header("Range");
  const auto if_range = request.header("If-Range");
  if (!range || request.method != "GET" || (if_range && *if_range != etag->second)) return response;

  const std::uint64_t size = response.body_size();
  ByteRange bytes{};
  switch (parse_range(*range, size, bytes)) {
    case RangeKind::none:
      return response;
    case RangeKind::outside: {
      auto refusal =
          to_response(make_problem("range-not-satisfiable", "the content has " + std::to_string(size) + " bytes"));
      refusal.headers["Content-Range"] = "bytes */" + std::to_string(size);
      return refusal;
    }
    case RangeKind::satisfiable:
      break;
  }
  response.status = 206;
  response.headers["Content-Range"] =
      "bytes " + std::to_string(bytes.first) + "-" + std::to_string(bytes.last) + "/" + std::to_string(size);
  const std::uint64_t length = bytes.last - bytes.first + 1;
  if (auto* file = std::get_if<FileBody>(&response.body)) {
    file->offset += bytes.first;
    file->length = length;
  } else {
    auto& text = std::get<std::string>(response.body);
    text = text.substr(bytes.first, length);
  }
  return response;
}

}  // namespace semblante::http

// The readers of what a request says in its target, its fields and its form: the first line of the input is the value
// of every field and the target, the rest is the body of a form with the boundary that the first line names.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <variant>

#include "core/types/percent_decode.h"
#include "server/http/address_range.h"
#include "server/http/conditional.h"
#include "server/http/content_coding.h"
#include "server/http/media_type.h"
#include "server/http/multipart.h"
#include "server/http/url.h"

using namespace semblante;

namespace {

void expect(bool fact) {
  if (!fact) std::abort();
}

void read_target(std::string_view text) {
  (void)http::absolute_target(text);
  const auto target = http::parse_target(text);
  if (target) expect(target->path.starts_with('/') && target->path.find('\0') == std::string::npos);
  for (const bool plus_is_space : {false, true}) {
    const auto decoded = percent_decode(text, plus_is_space);
    expect(!decoded || decoded->size() <= text.size());
  }
}

void read_lists(std::string_view text) {
  expect(http::essence(text).size() <= text.size());
  http::accepts(text, "application/json");
  http::accepts_coding(text, "gzip");
  std::size_t bytes = 0;
  for (const auto& item : http::split_list(text)) bytes += item.size();
  expect(bytes <= text.size());
}

/// The parts lie within the body, one behind the other.
void read_form(std::string_view body, std::string_view boundary) {
  const auto parts = http::parse_multipart(body, boundary);
  if (!parts) return;
  expect(parts->size() <= 16);
  const char* at = body.data();
  for (const auto& part : *parts) {
    if (part.content.empty()) continue;
    const std::less_equal<> before;
    expect(before(at, part.content.data()));
    at = part.content.data() + part.content.size();
    expect(before(at, body.data() + body.size()));
  }
}

void read_conditions(const std::string& text) {
  const std::string content(1000, 'x'), etag = "\"e\"";
  for (const char* field : {"Range", "If-None-Match", "If-Match", "If-Range"}) {
    http::Request request;
    request.method = "GET";
    request.headers["Range"] = "bytes=10-19";
    request.headers[field] = text;
    const auto response = http::apply_conditions(request, {200, {{"ETag", etag}}, content});
    const auto size = response.body_size();
    switch (response.status) {
      case 200:
        expect(size == content.size());
        break;
      case 206:
        expect(size > 0 && size <= content.size() && response.headers.contains("Content-Range"));
        break;
      default:
        expect(response.status == 304 || response.status == 412 || response.status == 416);
    }
  }
}

void read_addresses(std::string_view text) {
  const auto range = http::AddressRange::parse(text);
  const auto address = http::parse_address(text.substr(0, text.find('/')));
  if (range && address) expect(range->contains(*address));
  if (address) expect(http::client_network(http::client_network(*address)) == http::client_network(*address));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string input(reinterpret_cast<const char*>(data), size);
  const auto end = std::min(input.find('\n'), input.size());
  const auto line = input.substr(0, end);
  read_target(line);
  read_lists(line);
  read_form(std::string_view(input).substr(std::min(end + 1, input.size())), http::parameter(line, "boundary"));
  read_conditions(line);
  read_addresses(line);
  return 0;
}

#include "server/access/requester.h"

#include "core/types/letter_case.h"
#include "server/http/media_type.h"

namespace semblante::access {

Requester requester_of(const http::Request& request, std::span<const http::AddressRange> proxies) {
  Requester requester{request.peer, request.secure};
  if (!http::any_contains(proxies, request.peer)) return requester;
  if (const auto scheme = request.header("X-Forwarded-Proto")) requester.secure = equal_ignoring_case(*scheme, "https");
  const auto list = http::split_list(request.header("X-Forwarded-For").value_or(""));
  // Each proxy appends the address of its own client; what lies before the first foreign one is that client's word.
  for (auto at = list.rbegin(); at != list.rend(); ++at) {
    if (!http::parse_address(*at)) break;
    requester.address = *at;
    if (!http::any_contains(proxies, *at)) break;
  }
  return requester;
}

}  // namespace semblante::access

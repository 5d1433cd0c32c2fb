#include "server/app/listening.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "server/app/serve_failure.h"

namespace semblante {
namespace {

std::string checked_address(std::string address, const std::string& option) {
  if (address == "localhost") address = "127.0.0.1";
  if (!http::parse_address(address)) fail_serve(option + ": " + address + " is not an IP address");
  return address;
}

/// "0.0.0.0:443" or "[::]:443".
net::Listener parse_place(const std::string& text, const std::string& option) {
  const auto colon = text.rfind(':');
  std::string host = text.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  net::Listener place;
  const char* const end = text.data() + text.size();
  const char* const digits = colon == std::string::npos ? end : text.data() + colon + 1;
  const auto [rest, error] = std::from_chars(digits, end, place.port);
  if (digits == end || error != std::errc() || rest != end)
    fail_serve(option + ": " + text + " is not ADDRESS:PORT, such as 0.0.0.0:443 or [::]:443");
  place.address = checked_address(host, option);
  return place;
}

bool is_loopback(const net::Listener& listener) { return http::is_loopback(*http::parse_address(listener.address)); }

[[noreturn]] void refuse_plain(const net::Listener& listener, const std::filesystem::path& data) {
  const auto place =
      (listener.address.find(':') == std::string::npos ? listener.address : "[" + listener.address + "]") + ":" +
      std::to_string(listener.port);
  fail_serve(
      place +
      " can be reached from other machines: whoever is on the way could read and change everything, tokens too. "
      "Give it TLS and a token:\n"
      "  semblante token create --data " +
      data.string() +
      " --scope admin\n"
      "  semblante serve --data " +
      data.string() + " --listen " + place +
      " --tls-cert cert.pem --tls-key key.pem\n"
      "For an afternoon at home, `semblante serve --lan` makes both. Behind a proxy with TLS on another machine, "
      "--trusted-proxy ADDRESS accepts that proxy's connections only.");
}

}  // namespace

Listening check_listening(const ListenOptions& options, const std::filesystem::path& data) {
  Listening listening;
  for (const auto& text : options.proxies) {
    const auto range = http::AddressRange::parse(text);
    if (!range) fail_serve("--trusted-proxy: " + text + " is no address or range, such as 10.0.0.1 or 10.0.0.0/8");
    listening.proxies.push_back(*range);
  }
  if (options.certificate.empty() != options.key.empty())
    fail_serve("--tls-cert and --tls-key are given together: the certificate and its private key");
  listening.tls = !options.certificate.empty();
  for (const auto& text : options.listen) listening.listeners.push_back(parse_place(text, "--listen"));
  if (listening.listeners.empty())
    listening.listeners.push_back({checked_address(options.address, "--address"), options.port, false});
  for (auto& listener : listening.listeners) listener.tls = listening.tls;
  if (!options.redirects.empty() && !listening.tls)
    fail_serve("--http-redirect needs --tls-cert and --tls-key: there is no https to redirect to");
  listening.is_public =
      !listening.proxies.empty() || !std::all_of(listening.listeners.begin(), listening.listeners.end(), is_loopback);
  for (const auto& listener : listening.listeners)
    if (!listener.tls && listening.proxies.empty() && !is_loopback(listener)) refuse_plain(listener, data);
  for (const auto& text : options.redirects) listening.listeners.push_back(parse_place(text, "--http-redirect"));
  listening.asks_for_tokens = listening.is_public || options.require_tokens;
  return listening;
}

std::string url_of(const net::Listener& listener, std::uint16_t port) {
  const bool is_six = listener.address.find(':') != std::string::npos;
  return (listener.tls ? "https://" : "http://") + (is_six ? "[" + listener.address + "]" : listener.address) + ":" +
         std::to_string(port);
}

}  // namespace semblante

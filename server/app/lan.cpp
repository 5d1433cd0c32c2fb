#include "server/app/lan.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <ifaddrs.h>
#include <memory>
#include <qrencode.h>

#include <arpa/inet.h>
#include <net/if.h>

#include "core/types/letter_case.h"
#include "server/app/listening.h"
#include "server/cli/command_failure.h"
#include "server/http/address_range.h"
#include "server/http/message.h"
#include "server/net/self_signed.h"
#include "server/store/data_files.h"

namespace semblante {
namespace {

template <auto Free>
struct Freed {
  template <class T>
  void operator()(T* object) const {
    Free(object);
  }
};

[[noreturn]] void fail_certificate(const std::string& what) {
  throw CommandFailure(CommandFailure::internal, "serve: --lan: " + what);
}

constexpr std::chrono::hours validity{397 * 24};  ///< clients refuse longer ones
constexpr std::chrono::hours least_left{24 * 7};

bool still_serves(const net::TlsFiles& files, const std::vector<std::string>& names) {
  const auto loaded = net::TlsContext::load(files);
  if (!loaded || (*loaded)->expires() < std::chrono::system_clock::now() + least_left) return false;
  const auto& known = (*loaded)->names();
  return std::all_of(names.begin(), names.end(),
                     [&](const auto& name) { return std::find(known.begin(), known.end(), name) != known.end(); });
}

bool serves_a_network(const ifaddrs& one) {
  return one.ifa_addr != nullptr && (one.ifa_flags & IFF_UP) != 0 && (one.ifa_flags & IFF_LOOPBACK) == 0;
}

bool is_unspecified(const http::AddressBytes& address) {
  return address == *http::parse_address("0.0.0.0") || address == *http::parse_address("::");
}

/// Whether connections to `name` arrive at a listener that is bound to `bound`.
bool leads_to(const std::string& name, const std::string& bound, std::span<const std::string> own) {
  const auto address = http::parse_address(name);
  if (!address) return !equal_ignoring_case(name, "localhost");
  if (http::is_loopback(*address) || std::find(own.begin(), own.end(), name) == own.end()) return false;
  const auto place = *http::parse_address(bound);
  if (!is_unspecified(place)) return *address == place;
  return (name.find(':') == std::string::npos) == (bound.find(':') == std::string::npos);
}

}  // namespace

std::vector<std::string> network_addresses() {
  ifaddrs* list = nullptr;
  if (::getifaddrs(&list) != 0) return {};
  const std::unique_ptr<ifaddrs, Freed<::freeifaddrs>> owner(list);
  std::vector<std::string> four, six;
  std::array<char, INET6_ADDRSTRLEN> text{};
  for (const auto* one = list; one != nullptr; one = one->ifa_next) {
    if (!serves_a_network(*one)) continue;
    if (one->ifa_addr->sa_family == AF_INET) {
      const auto& address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr;
      if (::inet_ntop(AF_INET, &address, text.data(), text.size()) != nullptr) four.emplace_back(text.data());
    } else if (one->ifa_addr->sa_family == AF_INET6) {
      const auto& address = reinterpret_cast<const sockaddr_in6*>(one->ifa_addr)->sin6_addr;
      if (IN6_IS_ADDR_LINKLOCAL(&address)) continue;
      if (::inet_ntop(AF_INET6, &address, text.data(), text.size()) != nullptr) six.emplace_back(text.data());
    }
  }
  four.insert(four.end(), six.begin(), six.end());
  return four;
}

std::vector<std::string> network_urls(std::span<const net::Listener> listeners, std::span<const std::uint16_t> ports,
                                      std::span<const std::string> certificate_names) {
  const auto own = network_addresses();
  std::vector<std::string> urls;
  for (std::size_t i = 0; i < listeners.size(); ++i) {
    if (!listeners[i].tls || http::is_loopback(*http::parse_address(listeners[i].address))) continue;
    for (const auto& name : certificate_names)
      if (leads_to(name, listeners[i].address, own)) urls.push_back(url_of({name, ports[i], true}, ports[i]));
  }
  return urls;
}

net::TlsFiles self_signed_certificate(const std::filesystem::path& data, const std::vector<std::string>& names) {
  const auto& [certificate, key] = store::home_certificate_files;
  net::TlsFiles files{data / certificate, data / key};
  const auto folder = files.certificate.parent_path();
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail_certificate(folder.string() + ": " + error.message());
  if (std::filesystem::exists(files.certificate, error) && still_serves(files, names)) return files;
  const auto made = net::write_self_signed(files, "Semblante at home", names, validity);
  if (!made) fail_certificate(made.error().message);
  return files;
}

std::string qr_code(std::string_view text) {
  const std::unique_ptr<QRcode, Freed<QRcode_free>> code(
      QRcode_encodeString8bit(std::string(text).c_str(), 0, QR_ECLEVEL_L));
  if (!code) return {};
  constexpr int margin = 4;  // as the standard asks
  const auto dark = [&](int row, int column) {
    if (row < 0 || column < 0 || row >= code->width || column >= code->width) return false;
    return (code->data[row * code->width + column] & 1U) != 0;
  };
  // Two rows in a line; black on white, whatever the colours of the terminal.
  std::string lines;
  for (int row = -margin; row < code->width + margin; row += 2) {
    lines += "\x1b[30;107m";
    for (int column = -margin; column < code->width + margin; ++column) {
      const bool upper = dark(row, column), lower = dark(row + 1, column);
      lines += upper && lower ? "█" : upper ? "▀" : lower ? "▄" : " ";
    }
    lines += "\x1b[0m\n";
  }
  return lines;
}

}  // namespace semblante

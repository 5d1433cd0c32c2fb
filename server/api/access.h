#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/http/message.h"
#include "server/http/problem.h"

namespace semblante::api {

/// Whether the Origin of a request is the server itself, under the name that the request was sent to. Another port of
/// the same machine is another origin: it may be another user's program.
bool is_own_origin(const http::Request& head);

/// The names of the certificate in use, which changes while the server runs. Any thread.
class CertificateNames {
 public:
  void set(std::vector<std::string> names) {
    const std::lock_guard lock(mutex_);
    names_ = std::move(names);
  }
  [[nodiscard]] bool contains(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> all() const {
    const std::lock_guard lock(mutex_);
    return names_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> names_;
};

/// Access control by the Host and Origin headers of a request, against foreign pages in a browser that reaches the
/// server: on a server without tokens it is the only one.
struct Access {
  /// Host names accepted besides localhost and the loopback addresses, without port; "*": any. With DNS rebinding a
  /// foreign page has the same origin as this server for its browser, but its Host is still the foreign name.
  std::vector<std::string> hosts;
  /// Origins whose pages may make changes and read answers, besides the server's own; "*": all.
  std::vector<std::string> origins;
  /// Origins whose pages may show the server's pages in a frame.
  std::vector<std::string> frame_origins = {};
  /// Accepted like `hosts`.
  std::shared_ptr<CertificateNames> certificate = std::make_shared<CertificateNames>();

  /// The problem with which a read-only request is refused; nullopt when it is allowed.
  [[nodiscard]] std::optional<http::Problem> refuse_reading(const http::Request& head) const;
  /// The same for a request that may make changes or opens a stream.
  [[nodiscard]] std::optional<http::Problem> refuse_changing(const http::Request& head) const;
  /// True without an Origin: only browsers send one.
  [[nodiscard]] bool origin_allowed(const http::Request& head) const;
};

}  // namespace semblante::api

#pragma once

#include <any>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "server/http/feed.h"

namespace semblante::http {

/// Orders header names without regard to ASCII case.
struct CaseInsensitiveLess {
  using is_transparent = void;
  bool operator()(std::string_view a, std::string_view b) const;
};

/// Field name -> value. A repeated field is joined by ", " as RFC 9110 section 5.3 allows.
using Headers = std::map<std::string, std::string, CaseInsensitiveLess>;

/// A body that was written to disk while it arrived. The last owner removes the file.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::filesystem::path path) : path_(std::move(path)) {}
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// `Request::route` before find_route().
constexpr std::size_t no_route = SIZE_MAX;

/// One request as plain values, independent of sockets.
struct Request {
  std::string id;                             ///< of this request, in its answer and in the log
  std::string method;                         ///< "GET", as sent
  std::string path;                           ///< percent-decoded, without the query
  std::string target;                         ///< path and query as sent
  std::map<std::string, std::string> query;   ///< percent-decoded
  std::string repeated;                       ///< a key that occurs more than once in the query; empty: none does
  Headers headers;                            ///< without hop-by-hop meaning
  std::string body;                           ///< if it is kept in memory
  std::shared_ptr<TemporaryFile> body_file;   ///< if the route keeps it on disk
  std::uint64_t body_size = 0;                ///< bytes, in memory or on disk
  std::size_t route = no_route;               ///< index of the application's route (Application::find_route)
  std::string allow;                          ///< the methods of the path, as in Allow; empty: unknown path
  std::map<std::string, std::string> params;  ///< of the route pattern: {"model", "k3f..."}
  std::string peer;                           ///< IP address of the other end of the connection
  bool secure = false;                        ///< the connection has TLS
  std::any requester;                         ///< who asks, as the application found out (Application::find_route)
  std::chrono::steady_clock::time_point received = std::chrono::steady_clock::now();  ///< when its header arrived

  [[nodiscard]] std::optional<std::string_view> header(std::string_view name) const;
  [[nodiscard]] std::optional<std::string_view> query_value(const std::string& name) const;
};

/// A file that is open until the end of this.
class OpenFile {
 public:
  /// For reading.
  explicit OpenFile(const std::filesystem::path& path);
  /// `flags`: of open(); new files are readable for their owner only.
  OpenFile(const std::filesystem::path& path, int flags);
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  /// -1 if it could not be opened.
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// errno of open(); 0 if it is open.
  [[nodiscard]] int error() const { return error_; }

 private:
  int descriptor_;
  int error_;
};

/// A range of bytes of a file that never changes.
struct FileBody {
  std::filesystem::path path;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::shared_ptr<TemporaryFile> owner = nullptr;  ///< of a file to be removed after sending
  std::shared_ptr<const OpenFile> open = nullptr;  ///< if the file may be removed before it is sent; else null
};

/// Empty, bytes, a file, or a feed of events.
using Body = std::variant<std::monostate, std::string, FileBody, std::shared_ptr<Feed>>;

/// One answer as plain values. `Content-Length`, `Connection` and `Date` are added by net.
struct Response {
  int status = 200;
  Headers headers;
  Body body;

  [[nodiscard]] std::uint64_t body_size() const;
};

/// The reason phrase of a status code; "Unknown" for one that the server never sends.
std::string_view reason_phrase(int status);

}  // namespace semblante::http

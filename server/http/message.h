#pragma once

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
bool equal_ignoring_case(std::string_view a, std::string_view b);

/// Field name -> value. A repeated field is joined by ", " as RFC 9110 section 5.3 allows.
using Headers = std::map<std::string, std::string, CaseInsensitiveLess>;

/// A body that was written to disk while it arrived. The file goes when the last holder does.
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

/// `Request::route` of one whose route was not looked for.
constexpr std::size_t no_route = SIZE_MAX;

/// One request as plain values: what a handler sees, whoever read it from whatever socket.
struct Request {
  std::string method;                        ///< "GET", as sent
  std::string path;                          ///< percent-decoded, without the query
  std::map<std::string, std::string> query;  ///< percent-decoded; of a repeated key the first counts
  Headers headers;                           ///< without hop-by-hop meaning
  std::string body;                          ///< when it was small enough to keep in memory
  std::shared_ptr<TemporaryFile> body_file;  ///< when the route wanted it on disk
  std::uint64_t body_size = 0;               ///< bytes, in memory or on disk
  std::size_t route = no_route;              ///< index of the application's: what it is for (Application::find_route)
  std::string allow;  ///< the methods that the path has, as in Allow; empty: there is no such path
  std::map<std::string, std::string> params;  ///< of the route pattern: {"model", "k3f..."}
  std::chrono::steady_clock::time_point received = std::chrono::steady_clock::now();  ///< its header

  [[nodiscard]] std::optional<std::string_view> header(std::string_view name) const;
  [[nodiscard]] std::optional<std::string_view> query_value(const std::string& name) const;
};

/// A run of bytes of a file that never changes once it has this name.
struct FileBody {
  std::filesystem::path path;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::shared_ptr<TemporaryFile> owner = nullptr;  ///< of a file that goes when it has been sent
};

/// Nothing, bytes, a file, or a feed of events that goes on until it ends itself.
using Body = std::variant<std::monostate, std::string, FileBody, std::shared_ptr<Feed>>;

/// One answer as plain values. `Content-Length`, `Connection` and `Date` are net's to write.
struct Response {
  int status = 200;
  Headers headers;
  Body body;

  [[nodiscard]] std::uint64_t body_size() const;
};

/// The reason phrase of a status code; "Unknown" for one that we never send.
std::string_view reason_phrase(int status);

}  // namespace semblante::http

#include "server/net/response_writer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <optional>
#include <unistd.h>
#include <vector>

#include "server/http/problem.h"
#include "server/http/request_id.h"
#include "server/log/log.h"
#include "server/net/body_file.h"
#include "server/net/waker.h"

namespace semblante::net {

namespace asio = boost::asio;

namespace {

constexpr std::size_t sent_piece_bytes = std::size_t{64} * 1024;
constexpr std::chrono::seconds heartbeat{15};
constexpr std::chrono::milliseconds look_for_stop{500};

std::string http_date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 40> text{};
  std::strftime(text.data(), text.size(), "%a, %d %b %Y %H:%M:%S GMT", &utc);
  return text.data();
}

/// A header value may quote a client: characters that could end the line are dropped.
void append_field(std::string& out, std::string_view name, std::string_view value) {
  out.append(name).append(": ");
  for (const char c : value)
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F) out.push_back(c);
  out.append("\r\n");
}

std::string header_of(const http::Response& response, unsigned version, bool chunked, bool keep_alive) {
  std::string out;
  out.reserve(512);
  out.append(version == 10 ? "HTTP/1.0 " : "HTTP/1.1 ").append(std::to_string(response.status)).append(" ");
  out.append(http::reason_phrase(response.status)).append("\r\n");
  for (const auto& [name, value] : response.headers) append_field(out, name, value);
  append_field(out, "Date", http_date());
  if (chunked) {
    if (version == 11) append_field(out, "Transfer-Encoding", "chunked");
  } else if (response.status != 204 && response.status != 304) {
    append_field(out, "Content-Length", std::to_string(response.body_size()));
  }
  append_field(out, "Connection", keep_alive ? "keep-alive" : "close");
  out.append("\r\n");
  return out;
}

asio::awaitable<bool> write_feed(Transport& transport, const std::shared_ptr<http::Feed>& feed, bool chunked,
                                 const SharedState& state) {
  const auto waker = std::make_shared<Waker>(transport.get_executor());
  feed->attach(waker->function());
  const auto send = [&](std::string_view piece) -> asio::awaitable<bool> {
    std::string framed;
    if (chunked) {
      std::array<char, 24> size{};
      std::snprintf(size.data(), size.size(), "%zx\r\n", piece.size());
      framed.append(size.data()).append(piece).append("\r\n");
    } else {
      framed = piece;
    }
    transport.expires_after(state.config.limits.write_timeout);
    co_return !co_await transport.write(framed);
  };

  bool alive = true;
  auto last_sent = std::chrono::steady_clock::now();
  while (alive) {
    if (const auto item = feed->take()) {
      alive = co_await send(*item->bytes);
      last_sent = std::chrono::steady_clock::now();
    } else if (feed->finished() || state.stopping) {
      break;
    } else if (std::chrono::steady_clock::now() - last_sent >= heartbeat) {
      // A comment line prevents timeouts of proxies and detects a closed connection.
      alive = co_await send(": still here\n\n");
      last_sent = std::chrono::steady_clock::now();
    } else {
      co_await waker->wait(look_for_stop);
    }
  }
  feed->attach({});
  if (alive && chunked) {
    transport.expires_after(state.config.limits.write_timeout);
    alive = !co_await transport.write("0\r\n\r\n");
  }
  co_return alive&& chunked;
}

/// The answer in the place of one whose file is not open. Other header fields stay: they say who may read it.
http::Response unreadable(const http::Response& response, const BodyFile& file) {
  auto instead = http::to_response(
      file.is_over_limit() ? http::make_problem("overloaded", "too many files are being sent; try again later")
                           : http::make_problem("storage-unavailable", "the file cannot be read; try again later"));
  instead.headers["Retry-After"] = "1";
  for (const auto& field : response.headers) {
    const auto& [name, value] = field;
    const bool is_of_the_file = name == "Content-Range" || name == "Content-Disposition" || name == "ETag" ||
                                name == "Accept-Ranges" || name == "Content-Encoding" || name == "Cache-Control" ||
                                name == "Last-Modified" || name == "Content-Location";
    if (!is_of_the_file) instead.headers.insert(field);
  }
  if (const auto id = response.headers.find(http::request_id_header); id != response.headers.end())
    http::add_request_id(instead, id->second);
  return instead;
}

asio::awaitable<bool> write_file(Transport& transport, const http::FileBody& body, int file, const SharedState& state) {
  std::vector<char> piece(std::min<std::uint64_t>(sent_piece_bytes, body.length));
  std::uint64_t sent = 0;
  const auto& limits = state.config.limits;
  const auto begin = std::chrono::steady_clock::now();
  while (sent < body.length) {
    const auto want = static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), body.length - sent));
    const auto got = ::pread(file, piece.data(), want, static_cast<off_t>(body.offset + sent));
    if (got <= 0) co_return false;
    // As of bodies that arrive: one that reads a little at a time would hold its file for days.
    const auto left = limits.body_time_left(begin, sent);
    transport.expires_after(std::min<std::chrono::steady_clock::duration>(limits.write_timeout, left));
    if (co_await transport.write({piece.data(), static_cast<std::size_t>(got)})) co_return false;
    sent += static_cast<std::uint64_t>(got);
  }
  co_return true;
}

}  // namespace

asio::awaitable<bool> write_response(Transport& transport, const http::Response& response, unsigned http_version,
                                     bool head_only, bool keep_alive, SharedState& state) {
  const auto* file = std::get_if<http::FileBody>(&response.body);
  std::optional<BodyFile> opened;  // before the header, which must not promise a body that cannot be read
  if (file != nullptr) {
    opened.emplace(state, *file);
    if (opened->descriptor() < 0) {
      if (!opened->is_over_limit())
        log::error("cannot open " + file->path.string() + ": " + std::strerror(opened->error()));
      const auto instead = unreadable(response, *opened);
      opened.reset();
      co_return co_await write_response(transport, instead, http_version, head_only, keep_alive, state);
    }
  }
  const auto* feed = std::get_if<std::shared_ptr<http::Feed>>(&response.body);
  const bool chunked = feed != nullptr && http_version == 11;
  if (feed != nullptr && !chunked) keep_alive = false;
  const std::string header = header_of(response, http_version, feed != nullptr, keep_alive);
  transport.expires_after(state.config.limits.write_timeout);

  const auto* text = std::get_if<std::string>(&response.body);
  if (text != nullptr && !head_only) {
    const bool sent = !co_await transport.write(header, *text);
    co_return sent&& keep_alive;
  }
  if (co_await transport.write(header)) co_return false;
  if (head_only) co_return keep_alive;
  if (file != nullptr) co_return co_await write_file(transport, *file, opened->descriptor(), state) && keep_alive;
  if (feed != nullptr) co_return co_await write_feed(transport, *feed, chunked, state) && keep_alive;
  co_return keep_alive;
}

}  // namespace semblante::net

#include "tests/integration/server/test_client.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <poll.h>
#include <spawn.h>
#include <stdexcept>
#include <unistd.h>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include "tests/integration/server/open_request.h"
#include "tests/support/api_exchange.h"

extern char** environ;

namespace semblante::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* temporary_name = "semblante-test-";

int connect_to(int port, int receive_buffer = 0) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (receive_buffer > 0) setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof(receive_buffer));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0) {
    ::close(socket);
    throw std::runtime_error("cannot connect");
  }
  return socket;
}

void send_all(int socket, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return;  // refused early: the answer is still to be read
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
}

/// False at the end of the stream or of the time.
bool read_some(int socket, std::string& into, Clock::time_point end) {
  pollfd wait{socket, POLLIN, 0};
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
  if (left <= 0 || ::poll(&wait, 1, static_cast<int>(left)) <= 0) return false;
  std::array<char, 65536> piece{};
  const auto got = ::recv(socket, piece.data(), piece.size(), 0);
  if (got <= 0) return false;
  into.append(piece.data(), static_cast<std::size_t>(got));
  return true;
}

std::string unchunk(std::string_view text) {
  std::string out;
  while (true) {
    const auto line = text.find("\r\n");
    if (line == std::string_view::npos) return out;
    const auto size = std::strtoul(std::string(text.substr(0, line)).c_str(), nullptr, 16);
    if (size == 0 || text.size() < line + 2 + size) return out;
    out.append(text.substr(line + 2, size));
    text.remove_prefix(line + 2 + size + 2);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / (temporary_name + std::string("XXXXXX"))).string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

ServerProcess::ServerProcess(const std::filesystem::path& data, const std::vector<std::string>& options)
    : error_file_(data.string() + ".log") {
  std::vector<std::string> arguments = {
      SEMBLANTE_BINARY_DIR "/bin/semblante", "serve", "--port", "0", "--data", data.string()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  std::vector<char*> argv;
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  std::array<int, 2> out{};
  if (::pipe2(out.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, error_file_.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  const int failed = posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(out[1]);
  if (failed != 0) throw std::runtime_error("cannot start the server");
  std::string line;
  const auto end = Clock::now() + testing::patience;
  while (line.find('\n') == std::string::npos) {
    pollfd wait{out[0], POLLIN, 0};
    std::array<char, 256> piece{};
    const auto got = ::poll(&wait, 1, 1000) > 0 ? ::read(out[0], piece.data(), piece.size()) : -1;
    if (got == 0 || Clock::now() > end) break;
    if (got > 0) line.append(piece.data(), static_cast<std::size_t>(got));
  }
  ::close(out[0]);
  const auto colon = line.rfind(':');
  if (line.find("semblante listening on http://") != 0 || colon == std::string::npos)
    throw std::runtime_error("the server did not start: " + errors());
  port_ = std::atoi(line.c_str() + colon + 1);
}

ServerProcess::~ServerProcess() {
  if (pid_ > 0) end(SIGKILL);
  std::error_code ignored;
  std::filesystem::remove(error_file_, ignored);
}

int ServerProcess::end(int signal) {
  ::kill(pid_, signal);
  int status = 0;
  if (!testing::eventually([&] { return ::waitpid(pid_, &status, WNOHANG) != 0; })) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, &status, 0);
  }
  pid_ = -1;
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

std::string ServerProcess::errors() const {
  std::ifstream stream(error_file_);
  return {(std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>()};
}

Reply parse_reply(const std::string& text) {
  Reply reply;
  const auto end = text.find("\r\n\r\n");
  if (end == std::string::npos || text.size() < 12) return reply;
  reply.status = std::atoi(text.c_str() + 9);
  std::size_t at = text.find("\r\n") + 2;
  while (at < end + 2) {
    const auto line_end = text.find("\r\n", at);
    const auto colon = text.find(": ", at);
    auto name = text.substr(at, colon - at);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    reply.headers[name] = text.substr(colon + 2, line_end - colon - 2);
    at = line_end + 2;
  }
  reply.body = text.substr(end + 4);
  if (reply.headers["transfer-encoding"] == "chunked") reply.body = unchunk(reply.body);
  return reply;
}

namespace {

/// Every answer has an id, and a problem document the same.
void expect_request_id(std::string_view request_text, const Reply& reply) {
  const auto id = reply.headers.find("x-request-id");
  const auto type = reply.headers.find("content-type");
  if (id == reply.headers.end() || id->second.empty()) {
    ADD_FAILURE() << request_text.substr(0, 200) << " is answered " << reply.status << " without X-Request-Id";
  } else if (!request_text.starts_with("HEAD ") && type != reply.headers.end() &&
             type->second == "application/problem+json" &&
             reply.body.find("\"request\":\"" + id->second + "\"") == std::string::npos) {
    ADD_FAILURE() << "the problem document is without the id " << id->second << ": " << reply.body;
  }
}

/// Fails the test when the answer is not one that openapi.json describes. Every exchange with a server comes here.
void expect_documented(std::string_view request_text, const Reply& reply) {
  if (reply.status == 0) return;
  expect_request_id(request_text, reply);
  if (reply.status == 101) return;
  const auto length = reply.headers.find("content-length");
  const bool head = request_text.starts_with("HEAD ");
  if (!head && length != reply.headers.end() && std::to_string(reply.body.size()) != length->second) return;  // cut off
  const auto field = [&](const char* name) {
    const auto found = reply.headers.find(name);
    return found == reply.headers.end() ? std::string() : found->second;
  };
  ApiExchange exchange;
  const auto first = request_text.substr(0, request_text.find("\r\n"));
  const auto space = first.find(' ');
  if (space != std::string_view::npos) {
    exchange.method = first.substr(0, space);
    exchange.target = first.substr(space + 1, first.find(' ', space + 1) - space - 1);
  }
  // Read like an answer: what follows the first line has the same form.
  const auto sent = parse_reply(std::string(request_text));
  const auto type = sent.headers.find("content-type");
  if (type != sent.headers.end()) exchange.request_type = type->second;
  exchange.request_body = sent.body;
  exchange.status = reply.status;
  exchange.type = field("content-type");
  exchange.body = reply.body;
  // The folders of the tests: no answer says where things are on the server's machine.
  for (const auto& [name, value] : reply.headers)
    if (value.find(temporary_name) != std::string::npos) ADD_FAILURE() << first << ": " << name << ": " << value;
  if (reply.body.find(temporary_name) != std::string::npos)
    ADD_FAILURE() << first << " says where things are: " << reply.body.substr(0, 2000);
  for (const auto& fault : exchange_faults(exchange))
    ADD_FAILURE() << first << " is answered " << reply.status << ", against openapi.json: " << fault << "\n"
                  << reply.body.substr(0, 2000);
}

}  // namespace

std::string raw_exchange(int port, std::string_view bytes, std::chrono::milliseconds limit) {
  const int socket = connect_to(port);
  send_all(socket, bytes);
  std::string text;
  const auto end = Clock::now() + limit;
  while (read_some(socket, text, end)) {
  }
  ::close(socket);
  expect_documented(bytes, parse_reply(text));
  return text;
}

Reply request(int port, const std::string& method, const std::string& target, const std::string& body,
              const Fields& fields) {
  std::string text = method + " " + target + " HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n";
  for (const auto& [name, value] : fields) text += name + ": " + value + "\r\n";
  if (!body.empty() || method == "PUT" || method == "PATCH")
    text += "Content-Length: " + std::to_string(body.size()) + "\r\n";
  return parse_reply(raw_exchange(port, text + "\r\n" + body));
}

OpenRequest::OpenRequest(int port, std::string_view begin) : socket_(connect_to(port)) { send(begin); }

OpenRequest::~OpenRequest() { ::close(socket_); }

void OpenRequest::send(std::string_view bytes) { send_all(socket_, bytes); }

Reply OpenRequest::answer() {
  const auto end = Clock::now() + testing::patience;
  while (true) {
    const auto head = buffer_.find("\r\n\r\n");
    const auto reply = parse_reply(buffer_);
    const auto length = reply.headers.find("content-length");
    if (head != std::string::npos && length != reply.headers.end()) {
      const auto whole = head + 4 + std::strtoul(length->second.c_str(), nullptr, 10);
      if (buffer_.size() >= whole) {
        auto answered = parse_reply(buffer_.substr(0, whole));
        buffer_.erase(0, whole);
        return answered;
      }
    }
    if (!read_some(socket_, buffer_, end)) return {};
  }
}

WebSocket::WebSocket(int port, const std::string& target, const std::string& subprotocols, const Fields& fields,
                     int receive_buffer)
    : socket_(connect_to(port, receive_buffer)) {
  std::string text = "GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n";
  text += "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n";
  if (!subprotocols.empty()) text += "Sec-WebSocket-Protocol: " + subprotocols + "\r\n";
  for (const auto& [name, value] : fields) text += name + ": " + value + "\r\n";
  send_all(socket_, text + "\r\n");
  const auto end = Clock::now() + testing::patience;
  while (buffer_.find("\r\n\r\n") == std::string::npos && read_some(socket_, buffer_, end)) {
  }
  handshake_ = parse_reply(buffer_);
  expect_documented(text, handshake_);
  const auto header_end = buffer_.find("\r\n\r\n");
  buffer_.erase(0, header_end == std::string::npos ? buffer_.size() : header_end + 4);
}

WebSocket::~WebSocket() { ::close(socket_); }

bool WebSocket::fill(std::size_t bytes, Clock::time_point end) {
  while (buffer_.size() < bytes)
    if (!read_some(socket_, buffer_, end)) return false;
  return true;
}

void WebSocket::send_frame(int opcode, std::string_view payload) {
  std::string frame(1, static_cast<char>(0x80 | opcode));
  if (payload.size() < 126) {
    frame.push_back(static_cast<char>(0x80 | payload.size()));
  } else if (payload.size() < 65536) {
    frame.push_back(static_cast<char>(0x80 | 126));
    frame.push_back(static_cast<char>(payload.size() >> 8U));
    frame.push_back(static_cast<char>(payload.size() & 255U));
  } else {
    frame.push_back(static_cast<char>(0x80 | 127));
    for (int shift = 56; shift >= 0; shift -= 8) frame.push_back(static_cast<char>((payload.size() >> shift) & 255U));
  }
  constexpr std::array<char, 4> mask = {0x12, 0x34, 0x56, 0x78};
  frame.append(mask.data(), mask.size());
  for (std::size_t i = 0; i < payload.size(); ++i) frame.push_back(static_cast<char>(payload[i] ^ mask[i % 4]));
  send_all(socket_, frame);
}

void WebSocket::send(std::string_view message, bool binary) { send_frame(binary ? 2 : 1, message); }

std::optional<std::string> WebSocket::receive(std::chrono::milliseconds limit) {
  const auto end = Clock::now() + limit;
  std::string message;
  while (true) {
    if (!fill(2, end)) return std::nullopt;
    const auto byte = [this](std::size_t i) { return static_cast<std::uint8_t>(buffer_[i]); };
    const bool last = (byte(0) & 0x80U) != 0;
    const int opcode = byte(0) & 15;
    std::size_t size = byte(1) & 127U;
    std::size_t header = 2;
    if (size >= 126) {
      const std::size_t extra = size == 126 ? 2 : 8;
      if (!fill(2 + extra, end)) return std::nullopt;
      size = 0;
      for (std::size_t i = 0; i < extra; ++i) size = size << 8U | byte(2 + i);
      header += extra;
    }
    if (!fill(header + size, end)) return std::nullopt;
    const auto payload = buffer_.substr(header, size);
    buffer_.erase(0, header + size);
    if (opcode == 9) {
      send_frame(10, payload);
    } else if (opcode == 8) {
      if (payload.size() >= 2)
        close_code_ = static_cast<std::uint8_t>(payload[0]) << 8 | static_cast<std::uint8_t>(payload[1]);
      send_frame(8, payload.substr(0, 2));
      return std::nullopt;
    } else if (opcode != 10) {
      if (opcode != 0) last_was_binary_ = opcode == 2;
      message += payload;
      if (last) return message;
    }
  }
}

}  // namespace semblante::test

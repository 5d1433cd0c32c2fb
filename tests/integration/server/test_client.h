#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "tests/support/wait.h"

namespace semblante::test {

/// A folder of its own that goes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The real `semblante serve` on a port it chose itself. Killed with the object.
class ServerProcess {
 public:
  /// Waits for the line that says it is ready.
  explicit ServerProcess(const std::filesystem::path& data, const std::vector<std::string>& options = {});
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] pid_t pid() const { return pid_; }
  /// Sends the signal and waits; the exit code, or minus the signal it died of.
  int end(int signal);
  [[nodiscard]] std::string errors() const;

 private:
  pid_t pid_ = -1;
  int port_ = 0;
  std::filesystem::path error_file_;
};

struct Reply {
  int status = 0;
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
};

using Fields = std::vector<std::pair<std::string, std::string>>;
inline const Fields json_type = {{"Content-Type", "application/json"}};
inline const Fields obj_type = {{"Content-Type", "model/obj"}};
inline const Fields form_type = {{"Content-Type", "multipart/form-data; boundary=border"}};

/// One request on a connection of its own, written by hand: the tests must not share the server's library.
Reply request(int port, const std::string& method, const std::string& target, const std::string& body = {},
              const Fields& fields = {});
/// Sends these bytes and reads until the server closes, or the time is over. Fails the test when
/// server/api/openapi.json does not describe the answer (tests/support/api_exchange.h), or when the answer contains the
/// path of a TemporaryFolder. request() and WebSocket check the same.
std::string raw_exchange(int port, std::string_view bytes, std::chrono::milliseconds limit = testing::patience);
Reply parse_reply(const std::string& text);

/// A WebSocket client of 200 lines that does as it is told, also what is wrong.
class WebSocket {
 public:
  WebSocket(int port, const std::string& target, const std::string& subprotocols, const Fields& fields = {},
            int receive_buffer = 0);
  ~WebSocket();
  WebSocket(const WebSocket&) = delete;
  WebSocket& operator=(const WebSocket&) = delete;

  [[nodiscard]] const Reply& handshake() const { return handshake_; }
  void send(std::string_view message, bool binary);
  void send_text(std::string_view message) { send(message, false); }
  /// The next message; nullopt when the socket closed or nothing came in time. Answers pings.
  std::optional<std::string> receive(std::chrono::milliseconds limit = testing::patience);
  /// The code of the close frame that came; 0 before one.
  [[nodiscard]] int close_code() const { return close_code_; }
  [[nodiscard]] bool last_was_binary() const { return last_was_binary_; }

 private:
  bool fill(std::size_t bytes, std::chrono::steady_clock::time_point end);
  void send_frame(int opcode, std::string_view payload);

  int socket_ = -1;
  Reply handshake_;
  std::string buffer_;
  int close_code_ = 0;
  bool last_was_binary_ = false;
};

}  // namespace semblante::test

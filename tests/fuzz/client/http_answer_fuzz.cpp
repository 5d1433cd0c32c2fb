// What a server may answer to the client of protocol/http. The first byte of the input says what is asked; the rest is
// the answer.

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "protocol/http/http_client.h"
#include "tests/fuzz/client/hostile_server.h"

using namespace semblante;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static auto& server = *new fuzz::HostileServer;
  if (size == 0) return 0;
  const std::string answer(reinterpret_cast<const char*>(data) + 1, size - 1);
  server.answer_with([&](std::string_view) { return answer; });

  constexpr std::size_t max_body = 4096;
  constexpr std::chrono::seconds patience{3};
  const client::HttpClient http(client::Url{"127.0.0.1", server.port(), ""},
                                {.max_body = max_body, .timeout = patience});
  const auto begin = std::chrono::steady_clock::now();
  if (data[0] == 'f') {
    const auto body = http.fetch("/");
    if (body ? body->size() > max_body : body.error().message.empty()) std::abort();
  } else {
    client::HttpRequest request;
    request.method = data[0] == 'h' ? "HEAD" : "GET";
    request.target = "/";
    const auto response = http.send(request);
    if (!response && response.error().message.empty()) std::abort();
    if (response && (response->body.size() > max_body || response->status < 0)) std::abort();
    if (response && data[0] == 'h' && !response->body.empty()) std::abort();
  }
  // The server closes after its answer, so nothing is left to wait for.
  if (std::chrono::steady_clock::now() - begin >= patience) std::abort();
  return 0;
}

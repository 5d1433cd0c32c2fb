#include "clients/native/viewer/address.h"

#include <charconv>

namespace semblante::viewer {
namespace {

Result<std::string> unescape(std::string_view escaped) {
  std::string text;
  for (std::size_t i = 0; i < escaped.size(); ++i) {
    if (escaped[i] != '%') {
      text += escaped[i];
      continue;
    }
    unsigned char byte = 0;
    const std::string_view digits = escaped.substr(i + 1, 2);
    const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
    if (digits.size() != 2 || problem != std::errc{} || end != digits.data() + 2) {
      return Error{ErrorCode::invalid_argument, std::string(escaped), "a % is followed by two hexadecimal digits"};
    }
    text += static_cast<char>(byte);
    i += 2;
  }
  return text;
}

}  // namespace

Result<StreamAddress> parse_stream_address(std::string_view text) {
  StreamAddress address;
  if (text.starts_with("ws://") || text.starts_with("wss://")) {
    address.server = "http" + std::string(text.substr(2));
  } else {
    address.server = text;
  }
  for (const std::string_view folder : {"/v1/streams/", "/view/"}) {
    const std::size_t at = address.server.find(folder);
    if (at == std::string::npos) {
      continue;
    }
    std::string_view name = std::string_view(address.server).substr(at + folder.size());
    auto stream = unescape(name.substr(0, name.find_first_of("/?#")));
    if (!stream) {
      return std::move(stream).error();
    }
    address.stream = *std::move(stream);
    address.server.resize(at);
    break;
  }
  return address;
}

}  // namespace semblante::viewer

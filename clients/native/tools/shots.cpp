#include "clients/native/tools/shots.h"

#include <charconv>

namespace semblante::tools {

Result<Shot> parse_shot(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto view = render::parse_view(text.substr(0, colon));
  const auto subject =
      colon == std::string::npos ? render::Subject::all : render::parse_subject(text.substr(colon + 1));
  if (!view || !subject) {
    return Error{
        ErrorCode::invalid_argument, text,
        "a shot must be VIEW or VIEW:SUBJECT with views front, left, right, three-quarter, three-quarter-right, "
        "below, above, back and subjects all, face, eyes, mouth"};
  }
  return Shot{text, *view, *subject};
}

Result<std::vector<Shot>> parse_shots(const std::vector<std::string>& texts) {
  std::vector<Shot> shots;
  for (const std::string& text : texts) {
    auto shot = parse_shot(text);
    if (!shot) {
      return std::move(shot).error();
    }
    shots.push_back(*std::move(shot));
  }
  return shots;
}

Result<render::PictureSize> parse_size(const std::string& text) {
  const auto read = [](std::string_view digits, int& value) {
    const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return problem == std::errc{} && end == digits.data() + digits.size() && value >= 16 && value <= 4096;
  };
  const std::size_t cross = text.find('x');
  render::PictureSize size;
  const bool good = cross == std::string::npos
                        ? read(text, size.width) && read(text, size.height)
                        : read(text.substr(0, cross), size.width) && read(text.substr(cross + 1), size.height);
  if (!good) {
    return Error{ErrorCode::invalid_argument, text, "a size must be WIDTHxHEIGHT or one number, each 16 to 4096"};
  }
  return size;
}

}  // namespace semblante::tools

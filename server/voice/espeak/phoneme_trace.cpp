#include "server/voice/espeak/phoneme_trace.h"

#include <algorithm>
#include <cstdlib>

namespace semblante::voice {
namespace {

constexpr std::string_view primary = "ˈ", secondary = "ˌ";
/// So many phonemes the trace may have that are not in the events (names of languages where they change).
constexpr std::size_t most_skipped = 8;

}  // namespace

PhonemeTrace::PhonemeTrace() : stream_(::open_memstream(&text_, &size_)) {}

PhonemeTrace::~PhonemeTrace() {
  if (stream_ != nullptr) std::fclose(stream_);
  std::free(text_);
}

void PhonemeTrace::read_on() {
  if (stream_ == nullptr || std::fflush(stream_) != 0) return;
  const std::string_view all(text_, size_);
  const std::string_view between = " _\n";
  while (read_ < all.size()) {
    const std::size_t end = std::min(all.find_first_of(between, read_), all.size());
    std::string_view token = all.substr(read_, end - read_);
    read_ = end + 1;
    Stress stress = Stress::none;
    for (const auto& [mark, means] : {std::pair{primary, Stress::primary}, std::pair{secondary, Stress::secondary}})
      while (token.starts_with(mark)) {
        token.remove_prefix(mark.size());
        stress = means;
      }
    if (!token.empty()) waiting_.push_back({std::string(token), stress});
  }
}

Stress PhonemeTrace::stress_of(std::string_view symbol) {
  if (symbol.empty()) return Stress::none;
  read_on();
  const auto last = waiting_.begin() + static_cast<std::ptrdiff_t>(std::min(most_skipped, waiting_.size()));
  // An event holds eight bytes of a symbol.
  const auto at = std::find_if(waiting_.begin(), last,
                               [symbol](const Traced& traced) { return traced.symbol.starts_with(symbol); });
  if (at == last) return Stress::none;
  const Stress stress = at->stress;
  waiting_.erase(waiting_.begin(), at + 1);
  return stress;
}

}  // namespace semblante::voice

#pragma once

#include <cstdio>
#include <deque>
#include <string>
#include <string_view>

#include "core/speech/utterance.h"

namespace semblante::voice {

/// The phonemes that espeak-ng writes to its trace, with their stress, which its events do not have. A clause is in the
/// trace before its events come.
class PhonemeTrace {
 public:
  PhonemeTrace();
  ~PhonemeTrace();
  PhonemeTrace(const PhonemeTrace&) = delete;
  PhonemeTrace& operator=(const PhonemeTrace&) = delete;

  /// The stream that espeak-ng writes to, with '_' between phonemes; null without memory.
  [[nodiscard]] std::FILE* stream() const { return stream_; }
  /// The stress of the next phoneme of the events; `none` where the trace does not have it.
  Stress stress_of(std::string_view symbol);

 private:
  struct Traced {
    std::string symbol;
    Stress stress;
  };
  void read_on();

  char* text_ = nullptr;
  std::size_t size_ = 0, read_ = 0;
  std::FILE* stream_ = nullptr;
  std::deque<Traced> waiting_;
};

}  // namespace semblante::voice

#pragma once

#include <vector>

#include "core/speech/utterance.h"

namespace semblante {

/// The sound's strength over time: root mean square of windows of `window_ms`, at every `step_ms`, of full scale.
class Loudness {
 public:
  static constexpr double step_ms = 10.0, window_ms = 30.0;
  explicit Loudness(const Utterance& utterance);

  [[nodiscard]] const std::vector<double>& steps() const { return steps_; }
  /// The mean from `begin` to `end`, ms.
  [[nodiscard]] double between(double begin, double end) const;

 private:
  std::vector<double> steps_;
};

/// The utterance with silence before and after it, ms: a face needs time to get ready and to come to rest.
Utterance with_silence(Utterance utterance, double before, double after);

}  // namespace semblante

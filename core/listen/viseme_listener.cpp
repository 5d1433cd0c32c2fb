#include "core/listen/viseme_listener.h"

namespace semblante {

std::optional<VisemeListener::Heard> VisemeListener::push(std::span<const float> samples, std::size_t& taken) {
  std::size_t part = 0;
  for (taken = 0;;) {
    const auto frame = features_.push(samples.subspan(taken), part);
    taken += part;
    if (!frame) return {};
    levels_[frames_ % levels_.size()] = static_cast<float>(frame->level);
    const auto probability = network_.step(frame->features);
    ++frames_;
    if (frames_ <= VisemeNetwork::look_ahead) continue;
    return Heard{frame->time - step_ms * static_cast<double>(VisemeNetwork::look_ahead), probability,
                 levels_[frames_ % levels_.size()]};
  }
}

}  // namespace semblante

#include "clients/gateways/net/pacer.h"

#include <algorithm>
#include <cmath>

namespace semblante::gateways {

void Pacer::arrived(double first, double now) {
  const double late = now - first;
  if (!delay_ || std::abs(late - *delay_) > jump_ms) {
    delay_ = late;
  } else {
    delay_ = std::max(late, *delay_ - fall * std::max(0.0, now - last_));
  }
  last_ = now;
}

}  // namespace semblante::gateways

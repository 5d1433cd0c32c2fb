#include "tests/support/true_clock.h"

#include <chrono>

#include "clients/native/client/live_stream.h"
#include "tests/support/wait.h"

namespace semblante::testing {

std::optional<TrueClock> measure_true_clock(const client::Url& server, const std::string& stream) {
  using Clock = std::chrono::steady_clock;
  // A busy machine answers late, which makes a round trip say little: then more of them are waited for, within reason.
  constexpr double good_enough = 1.5;
  const auto begin = Clock::now();
  client::LiveStream direct(server, stream);
  const auto uncertainty = [&] { return direct.clock().uncertainty().value_or(1e9); };
  for (auto spent = Clock::duration::zero();
       spent < std::chrono::seconds(1) || (uncertainty() > good_enough && spent < std::chrono::seconds(10)) ||
       (!direct.clock().uncertainty() && spent < patience);
       spent = Clock::now() - begin) {
    if (!direct.next(std::chrono::milliseconds(50))) return std::nullopt;
  }
  if (!direct.clock().uncertainty()) return std::nullopt;
  const double now = client::LiveStream::now();
  return TrueClock{*direct.clock().at(now) - now, uncertainty()};
}

}  // namespace semblante::testing

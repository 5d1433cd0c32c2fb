#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "server/access/scope.h"

namespace semblante::access {

/// What a requester may do.
struct Rights {
  Scope scope = Scope::none;
  std::string stream = {};  ///< of this stream only, and of the model that it shows only reading; empty: of all
  std::string model = {};   ///< of this model only; empty: of all
  std::string token = {};   ///< id of the token; empty: without one

  std::shared_ptr<const std::atomic<bool>> ended = nullptr;  ///< becomes true when the token ends; null without one

  [[nodiscard]] bool limited() const { return !stream.empty() || !model.empty(); }
};

}  // namespace semblante::access

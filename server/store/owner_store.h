#pragma once

#include <cstdint>
#include <string_view>

namespace semblante::store {

/// What the requests of one token have made and what is still there.
struct Usage {
  std::uint64_t bytes = 0;  ///< of the artefacts of its models, each content once, of its recordings, speeches and sets
  std::uint64_t models = 0;
  std::uint64_t sets = 0;  ///< and extractions that have not ended: each may make one
  std::uint64_t streams = 0;
  std::uint64_t recordings = 0;
  std::uint64_t speeches = 0;
  std::uint64_t jobs = 0;  ///< that have not ended

  bool operator==(const Usage&) const = default;
};

/// Records by their owner (Origin). The rules of Store (store.h) hold.
class OwnerStore {
 public:
  virtual ~OwnerStore() = default;

  /// A running recording counts with the bytes that it had when it was created.
  virtual Usage usage_of(std::string_view owner) = 0;
};

}  // namespace semblante::store

#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/token_bucket.h"
#include "server/access/rights.h"
#include "server/access/secret.h"
#include "server/store/token_store.h"

namespace semblante::access {

/// The result of looking at a token.
enum class Verdict : std::uint8_t {
  accepted,
  unknown,  ///< no such token: never made, revoked, or another secret
  expired,
  busy,  ///< too many tokens with a wrong secret were tried lately: try again
};

struct Verification {
  Verdict verdict = Verdict::unknown;
  Rights rights;  ///< when accepted
};

/// The tokens of this server, in memory, so that a request need not wait for the store. Any thread.
class TokenRegistry {
 public:
  /// Seconds since 1970; a test's clock may be another.
  using Now = std::function<std::int64_t()>;
  explicit TokenRegistry(Now now = {});

  /// The tokens of now: those that are missing are revoked from this moment. Waits for the store.
  void load(store::TokenStore& store);
  /// The same, and ends the rights of tokens that have expired, if another program has changed the store or the time
  /// has come. To be called about once a second.
  void refresh(store::TokenStore& store);
  /// The first use of a token takes about 2 ms of computation, later ones some microseconds. Wrong secrets take the
  /// same 2 ms, so only a few per second are looked at.
  Verification verify(std::string_view text);
  [[nodiscard]] bool empty() const;

 private:
  struct Entry {
    store::TokenRecord record;
    std::string digest;                        ///< of the text, after its first use
    std::shared_ptr<std::atomic<bool>> ended;  ///< shared with the rights that were given
  };

  void replace(std::vector<store::TokenRecord> tokens);
  static Verification verdict_of(Entry& entry, std::int64_t now);

  const Now now_;
  const DigestKey key_;
  std::mutex loading_;  ///< held while the store is read, so that an earlier list does not replace a later one
  std::int64_t seen_changes_ = 0;  ///< guarded by loading_
  mutable std::mutex mutex_;       ///< guards what follows
  std::map<std::string, Entry, std::less<>> tokens_;
  TokenBucket tries_;  ///< of computations
};

}  // namespace semblante::access

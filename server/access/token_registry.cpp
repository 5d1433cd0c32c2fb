#include "server/access/token_registry.h"

#include <ctime>
#include <utility>

namespace semblante::access {
namespace {

constexpr double tries_per_second = 20, burst_of_tries = 100;

bool has_expired(const store::TokenRecord& token, std::int64_t now) { return token.expires && *token.expires <= now; }

}  // namespace

Verification TokenRegistry::verdict_of(Entry& entry, std::int64_t now) {
  const auto& token = entry.record;
  if (has_expired(token, now)) return {Verdict::expired, {}};
  const auto scope = parse_scope(token.scope);
  if (!scope) return {};
  // It had expired, and the clock was set back: the rights that ended stay so.
  if (*entry.ended) entry.ended = std::make_shared<std::atomic<bool>>(false);
  return {Verdict::accepted, {*scope, token.stream, token.model, token.id, entry.ended}};
}

TokenRegistry::TokenRegistry(Now now)
    : now_(now ? std::move(now) : [] { return static_cast<std::int64_t>(std::time(nullptr)); }),
      tries_(tries_per_second, burst_of_tries) {}

void TokenRegistry::load(store::TokenStore& store) {
  const std::lock_guard loading(loading_);
  replace(store.tokens());
}

void TokenRegistry::refresh(store::TokenStore& store) {
  {
    const std::lock_guard loading(loading_);
    const auto changes = store.changes_by_others();
    if (changes != seen_changes_) replace(store.tokens());
    seen_changes_ = changes;
  }
  const std::lock_guard lock(mutex_);
  for (const auto& [id, entry] : tokens_)
    if (has_expired(entry.record, now_())) *entry.ended = true;
}

void TokenRegistry::replace(std::vector<store::TokenRecord> tokens) {
  const std::lock_guard lock(mutex_);
  std::map<std::string, Entry, std::less<>> replaced;
  for (auto& token : tokens) {
    const auto id = token.id;
    const auto known = tokens_.find(id);
    if (known != tokens_.end() && known->second.record == token)
      replaced.insert(tokens_.extract(known));
    else
      replaced.emplace(id, Entry{std::move(token), {}, std::make_shared<std::atomic<bool>>(false)});
  }
  for (const auto& [id, entry] : tokens_) *entry.ended = true;
  tokens_ = std::move(replaced);
}

Verification TokenRegistry::verify(std::string_view text) {
  const auto token = parse_token(text);
  if (!token) return {};
  const auto digest = key_.digest(text);
  std::string hash;
  {
    const std::lock_guard lock(mutex_);
    const auto found = tokens_.find(token->id);
    if (found == tokens_.end()) return {};
    if (!found->second.digest.empty() && equal_in_constant_time(found->second.digest, digest))
      return verdict_of(found->second, now_());
    if (!tries_.take(1.0, TokenBucket::Clock::now())) return {Verdict::busy, {}};
    hash = found->second.record.secret_hash;
  }
  if (!matches_hash(token->secret, hash)) return {};
  const std::lock_guard lock(mutex_);
  const auto found = tokens_.find(token->id);
  if (found == tokens_.end() || found->second.record.secret_hash != hash) return {};  // revoked meanwhile
  found->second.digest = digest;
  return verdict_of(found->second, now_());
}

bool TokenRegistry::empty() const {
  const std::lock_guard lock(mutex_);
  return tokens_.empty();
}

}  // namespace semblante::access

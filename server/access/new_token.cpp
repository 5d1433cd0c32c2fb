#include "server/access/new_token.h"

#include <ctime>

#include "server/access/secret.h"

namespace semblante::access {

NewToken make_token(const TokenWish& wish) {
  const TokenText text{store::random_id(), random_secret()};
  store::TokenRecord record{
      text.id, wish.name, std::string(scope_name(wish.scope)), wish.stream, wish.model, store::timestamp_now(), {}, {}};
  if (wish.life) record.expires = static_cast<std::int64_t>(std::time(nullptr)) + *wish.life;
  record.secret_hash = hash_secret(text.secret);
  return {std::move(record), to_text(text)};
}

}  // namespace semblante::access

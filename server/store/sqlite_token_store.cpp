#include "server/store/sqlite_token_store.h"

#include <mutex>

namespace semblante::store {

void SqliteTokenStore::add_token(const TokenRecord& token) {
  const std::lock_guard lock(mutex_);
  Statement(db_,
            "INSERT INTO tokens(id, name, scope, stream, model, created, expires, secret_hash) VALUES(?,?,?,?,?,?,?,?)")
      .bind(token.id, token.name, token.scope, token.stream, token.model, token.created, token.expires,
            token.secret_hash)
      .run();
}

std::vector<TokenRecord> SqliteTokenStore::tokens() {
  const std::lock_guard lock(mutex_);
  std::vector<TokenRecord> list;
  Statement row(db_,
                "SELECT id, name, scope, stream, model, created, expires, secret_hash FROM tokens ORDER BY number");
  while (row.step()) {
    TokenRecord token{row.text(0), row.text(1), row.text(2), row.text(3), row.text(4), row.text(5), {}, row.text(7)};
    if (!row.is_null(6)) token.expires = row.whole<std::int64_t>(6);
    list.push_back(std::move(token));
  }
  return list;
}

bool SqliteTokenStore::remove_token(std::string_view id) {
  const std::lock_guard lock(mutex_);
  Statement(db_, "DELETE FROM tokens WHERE id = ?").bind(id).run();
  return db_.changes() != 0;
}

std::int64_t SqliteTokenStore::changes_by_others() {
  const std::lock_guard lock(mutex_);
  Statement statement(db_, "PRAGMA data_version");
  return statement.step() ? statement.integer(0) : 0;
}

}  // namespace semblante::store

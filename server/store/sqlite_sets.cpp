#include "server/store/sqlite_sets.h"

#include <string>

namespace semblante::store {
namespace {

constexpr const char* set_columns =
    "SELECT id, name, kind, revision, created, updated, displacements, source, owner FROM displacement_sets ";

SetRecord read_set(const Statement& row) {
  return {row.text(0), row.text(1), row.text(2), row.whole(3), row.text(4),
          row.text(5), row.json(6), row.json(7), row.text(8)};
}

}  // namespace

void insert_set(Database& db, const SetRecord& set) {
  Statement(db, "INSERT INTO displacement_sets VALUES(NULL,?,?,?,?,?,?,?,?,?)")
      .bind(set.id, set.name, set.kind, set.revision, set.created, set.updated, set.displacements, set.source,
            set.owner)
      .run();
}

std::optional<SetRecord> find_set(Database& db, std::string_view id) {
  Statement statement(db, std::string(set_columns) + "WHERE id = ?");
  statement.bind(id);
  if (!statement.step()) return std::nullopt;
  return read_set(statement);
}

std::optional<std::vector<SetRecord>> list_sets(Database& db, std::string_view after, std::size_t limit) {
  std::int64_t number = 0;
  if (!after.empty()) {
    Statement statement(db, "SELECT number FROM displacement_sets WHERE id = ?");
    statement.bind(after);
    if (!statement.step()) return std::nullopt;
    number = statement.integer(0);
  }
  std::vector<SetRecord> list;
  Statement statement(db, std::string(set_columns) + "WHERE number > ? ORDER BY number LIMIT ?");
  statement.bind(number, static_cast<std::uint64_t>(limit));
  while (statement.step()) list.push_back(read_set(statement));
  return list;
}

std::vector<WornSet> read_worn(Database& db, std::string_view model) {
  std::vector<WornSet> list;
  Statement statement(db,
                      "SELECT slot, displacement_set, name, revision, displacements FROM worn_sets WHERE model = ? "
                      "ORDER BY slot");
  statement.bind(model);
  while (statement.step())
    list.push_back({statement.text(0), statement.text(1), statement.text(2), statement.whole(3), statement.json(4)});
  return list;
}

std::vector<WornSet> read_worn_names(Database& db, std::string_view model) {
  std::vector<WornSet> list;
  Statement statement(db, "SELECT slot, displacement_set, name, revision FROM worn_sets WHERE model = ? ORDER BY slot");
  statement.bind(model);
  while (statement.step())
    list.push_back({statement.text(0), statement.text(1), statement.text(2), statement.whole(3), ""});
  return list;
}

void write_worn(Database& db, std::string_view model, const WornSet& worn) {
  if (worn.displacements.empty()) {
    Statement(db, "DELETE FROM worn_sets WHERE model = ? AND slot = ?").bind(model, worn.slot).run();
    return;
  }
  Statement(db, "INSERT OR REPLACE INTO worn_sets VALUES(?,?,?,?,?,?)")
      .bind(model, worn.slot, worn.set, worn.name, worn.revision, worn.displacements)
      .run();
}

}  // namespace semblante::store

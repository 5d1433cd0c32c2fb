#include "server/store/sqlite_streams.h"

#include <string>

#include "server/store/store_error.h"

namespace semblante::store {
namespace {

/// ", title, model, ...": the columns of the settings.
std::string setting_columns() {
  std::string columns;
  const settings::StreamSettings any;
  settings::for_each_setting(any, [&](std::string_view name, const auto&) { columns.append(", ").append(name); });
  return columns;
}

void load(const Statement& row, int column, std::string& value) { value = row.text(column); }
void load(const Statement& row, int column, double& value) { value = row.real(column); }
void load(const Statement& row, int column, std::uint32_t& value) { value = row.whole<std::uint32_t>(column); }
void load(const Statement& row, int column, bool& value) { value = row.integer(column) != 0; }
void load(const Statement& row, int column, std::optional<double>& value) {
  if (!row.is_null(column)) value = row.real(column);
}

}  // namespace

bool insert_stream(Database& db, const StreamRecord& stream) {
  std::string marks;
  settings::for_each_setting(stream.settings, [&](std::string_view, const auto&) { marks += ",?"; });
  Statement insert(
      db, "INSERT OR IGNORE INTO streams(id, created, owner" + setting_columns() + ") VALUES(?,?,?" + marks + ")");
  insert.bind(stream.id, stream.created, stream.owner);
  settings::for_each_setting(stream.settings, [&](std::string_view, const auto& value) { insert.bind(value); });
  insert.run();
  return db.changes() != 0;
}

std::vector<StreamRecord> list_streams(Database& db) {
  std::vector<StreamRecord> list;
  Statement row(db, "SELECT id, created, owner" + setting_columns() + " FROM streams ORDER BY number");
  while (row.step()) {
    StreamRecord stream{row.text(0), row.text(1), {}, row.text(2)};
    int column = 3;
    settings::for_each_setting(stream.settings, [&](std::string_view, auto& value) { load(row, column++, value); });
    if (const auto name = settings::invalid_setting(stream.settings))
      throw DamagedDatabase("the database is damaged: no request has given the stream `" + stream.id + "` its " +
                            std::string(*name));
    list.push_back(std::move(stream));
  }
  return list;
}

}  // namespace semblante::store

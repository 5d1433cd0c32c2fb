#include "server/store/sqlite_models.h"

#include <string>

#include "server/store/facts_json.h"
#include "server/store/sqlite_sets.h"

namespace semblante::store {
namespace {

constexpr const char* model_columns =
    "SELECT m.id, m.name, m.state, m.problem, m.created, m.updated, m.revision, m.file_name, m.format, "
    "m.source_bytes, m.source_sha256, m.vertices, m.triangles, m.facts, m.points_revision, "
    "(SELECT count(*) FROM feature_points f WHERE f.model = m.id), "
    "p.parametrization, p.created, p.metric, p.weights, p.weight_bits, p.levels, m.owner "
    "FROM models m LEFT JOIN packages p ON p.model = m.id ";

ModelRecord read_model(const Statement& row) {
  ModelRecord model;
  model.id = row.text(0);
  model.name = row.text(1);
  model.state = row.one_of(ModelState::failed, 2);
  model.problem = row.json(3);
  model.created = row.text(4);
  model.updated = row.text(5);
  model.revision = row.whole(6);
  model.file_name = row.text(7);
  model.format = row.text(8);
  model.source_bytes = row.whole(9);
  model.source_sha256 = row.text(10);
  model.vertices = row.whole<std::uint32_t>(11);
  model.triangles = row.whole<std::uint32_t>(12);
  read_facts(row.text(13), model);
  model.feature_points_revision = row.whole(14);
  model.feature_point_count = row.whole<std::uint32_t>(15);
  model.owner = row.text(22);
  if (!row.is_null(16))
    model.package = PackageRecord{row.text(16), row.text(17),       row.text(18),
                                  row.text(19), row.whole<int>(20), read_levels(row.text(21))};
  return model;
}

}  // namespace

bool insert_model(Database& db, const ModelRecord& model) {
  Statement(db, "INSERT OR IGNORE INTO models VALUES(NULL,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
      .bind(model.id, model.name, static_cast<int>(model.state), model.problem, model.created, model.updated,
            model.revision, model.file_name, model.format, model.source_bytes, model.source_sha256, model.vertices,
            model.triangles, write_facts(model), model.feature_points_revision, model.owner)
      .run();
  return db.changes() != 0;
}

std::optional<ModelRecord> find_model(Database& db, std::string_view id) {
  Statement statement(db, std::string(model_columns) + "WHERE m.id = ?");
  statement.bind(id);
  if (!statement.step()) return std::nullopt;
  auto model = read_model(statement);
  model.worn = read_worn_names(db, model.id);
  return model;
}

std::optional<std::vector<ModelRecord>> list_models(Database& db, std::string_view after, std::size_t limit) {
  std::int64_t number = 0;
  if (!after.empty()) {
    Statement statement(db, "SELECT number FROM models WHERE id = ?");
    statement.bind(after);
    if (!statement.step()) return std::nullopt;
    number = statement.integer(0);
  }
  std::vector<ModelRecord> list;
  Statement statement(db, std::string(model_columns) + "WHERE m.number > ? ORDER BY m.number LIMIT ?");
  statement.bind(number, static_cast<std::uint64_t>(limit));
  while (statement.step()) list.push_back(read_model(statement));
  for (auto& model : list) model.worn = read_worn_names(db, model.id);
  return list;
}

std::vector<FeaturePointRecord> read_points(Database& db, std::string_view model) {
  std::vector<FeaturePointRecord> points;
  Statement statement(db, "SELECT id, vertex, x, y, z, proposal FROM feature_points WHERE model = ? ORDER BY position");
  statement.bind(model);
  while (statement.step()) {
    FeaturePointRecord point;
    point.id = statement.text(0);
    if (!statement.is_null(1)) point.vertex = statement.whole<std::uint32_t>(1);
    if (!statement.is_null(2)) point.position = {statement.real(2), statement.real(3), statement.real(4)};
    if (!statement.is_null(5)) point.proposal = read_proposal(statement.text(5));
    points.push_back(std::move(point));
  }
  return points;
}

void write_points(Database& db, std::string_view model, const std::vector<FeaturePointRecord>& points) {
  Statement(db, "DELETE FROM feature_points WHERE model = ?").bind(model).run();
  int position = 0;
  for (const auto& point : points) {
    std::optional<double> x, y, z;
    if (point.position) {
      x = (*point.position)[0];
      y = (*point.position)[1];
      z = (*point.position)[2];
    }
    std::optional<std::string> proposal;
    if (point.proposal) proposal = write_proposal(*point.proposal);
    Statement(db, "INSERT INTO feature_points(model, position, id, vertex, x, y, z, proposal) VALUES(?,?,?,?,?,?,?,?)")
        .bind(model, position++, point.id, point.vertex, x, y, z, proposal)
        .run();
  }
}

void turn_points(Database& db, std::string_view model, const Turn& r) {
  Statement(db,
            "UPDATE feature_points SET x = ?*x + ?*y + ?*z, y = ?*x + ?*y + ?*z, z = ?*x + ?*y + ?*z "
            "WHERE model = ? AND x IS NOT NULL")
      .bind(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8], model)
      .run();
  Statement(db, "UPDATE models SET points_revision = points_revision + 1 WHERE id = ? AND points_revision > 0")
      .bind(model)
      .run();
}

}  // namespace semblante::store

// A database of every earlier version of the schema opens with all that it had, and is afterwards as a new one.

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <sqlite3.h>

#include <gtest/gtest.h>

#include "server/store/sqlite_store.h"

namespace semblante::store {
namespace {

namespace fs = std::filesystem;

/// SQLite without the store.
class Raw {
 public:
  explicit Raw(const fs::path& file) { EXPECT_EQ(sqlite3_open(file.c_str(), &handle_), SQLITE_OK); }
  ~Raw() { sqlite3_close(handle_); }
  Raw(const Raw&) = delete;
  Raw& operator=(const Raw&) = delete;
  void execute(const std::string& sql) {
    EXPECT_EQ(sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(handle_);
  }
  /// The values of all rows, one after another.
  std::vector<std::string> values(const std::string& sql) {
    std::vector<std::string> found;
    const auto add = [](void* to, int count, char** values, char** /*names*/) {
      for (int i = 0; i < count; ++i)
        static_cast<std::vector<std::string>*>(to)->emplace_back(values[i] != nullptr ? values[i] : "NULL");
      return 0;
    };
    EXPECT_EQ(sqlite3_exec(handle_, sql.c_str(), add, &found, nullptr), SQLITE_OK) << sqlite3_errmsg(handle_);
    return found;
  }
  /// Columns of every table, with their types, keys and references; indices.
  std::map<std::string, std::vector<std::string>> schema() {
    std::map<std::string, std::vector<std::string>> tables;
    for (const auto& table :
         values("SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite_%'")) {
      // The order of columns that a migration added is not that of a new table's.
      tables[table] = values("SELECT name, type, \"notnull\", dflt_value, pk FROM pragma_table_info('" + table +
                             "') ORDER BY name");
      for (auto& value : values("SELECT \"table\", \"from\", \"to\", on_delete FROM pragma_foreign_key_list('" + table +
                                "') ORDER BY 1, 2"))
        tables[table].push_back(std::move(value));
    }
    tables["indices"] = values("SELECT name, tbl_name FROM sqlite_master WHERE type = 'index' ORDER BY name");
    return tables;
  }

 private:
  sqlite3* handle_ = nullptr;
};

std::string hash_of(char c) { return std::string(64, c); }

class MigrationTest : public ::testing::Test {
 protected:
  MigrationTest() {
    std::string name = (fs::temp_directory_path() / "semblante-migration-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~MigrationTest() override { fs::remove_all(folder_); }

  [[nodiscard]] static fs::path dump_of(int version) {
    return fs::path(SEMBLANTE_SOURCE_DIR) / "tests/unit/store/schemas" /
           ("version_" + std::to_string(version) + ".sql");
  }
  [[nodiscard]] fs::path file_of(int version) const { return folder_ / (std::to_string(version) + ".sqlite"); }
  void make(int version) const {
    std::ifstream stream(dump_of(version));
    ASSERT_TRUE(stream) << dump_of(version) << " is missing: a dump of a filled database of that version";
    Raw(file_of(version)).execute({std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()});
  }
  /// All versions before the newest, and the newest as soon as there is a dump of it.
  [[nodiscard]] static std::vector<int> versions(int newest_version) {
    std::vector<int> list;
    for (int version = 1; version < newest_version || (version == newest_version && fs::exists(dump_of(version)));
         ++version)
      list.push_back(version);
    return list;
  }
  /// The version that a new database has.
  [[nodiscard]] int newest() const {
    EXPECT_TRUE(open_sqlite_store(folder_ / "new.sqlite"));
    return std::stoi(Raw(folder_ / "new.sqlite").values("PRAGMA user_version")[0]);
  }

  fs::path folder_;
};

void expect_all_there(Store& store, int version) {
  const auto face = store.model("face");
  ASSERT_TRUE(face);
  EXPECT_EQ(face->name, "Ana");
  EXPECT_EQ(face->state, ModelState::parametrized);
  EXPECT_EQ(face->source_sha256, hash_of('a'));
  EXPECT_EQ(face->feature_points_revision, 2U);
  EXPECT_EQ(face->warnings, std::vector<std::string>{"a hole"});
  ASSERT_EQ(face->parts.size(), 2U);
  EXPECT_EQ(face->part_count, 2U);
  EXPECT_TRUE(face->parts[0].role_by_user);
  EXPECT_EQ(face->parts[1].index, 1U);
  ASSERT_TRUE(face->package);
  EXPECT_EQ(face->package->weights, "smooth");
  EXPECT_EQ(face->package->levels.size(), version >= 3 ? 1U : 0U);
  EXPECT_EQ(store.model("new")->state, ModelState::importing);
  const auto points = store.feature_points("face");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].vertex, 5U);
  EXPECT_EQ(points[1].position, (std::array<double, 3>{0.5, 1.5, 0.25}));
  EXPECT_EQ(points[1].proposal.has_value(), version >= 2);
  EXPECT_EQ(store.artefacts("face").size(), 5U);
  EXPECT_EQ(store.artefact("face", "weights")->sha256, hash_of('f'));
  EXPECT_EQ(store.job("job-i")->kind, "import");
  EXPECT_EQ(store.job("job-p")->state, JobState::done);
  EXPECT_EQ(store.job("job-p")->request, version >= 3
                                             ? R"({"metric":"edge","weights":"smooth","weight_bits":12,"lods":[5000]})"
                                             : R"({"metric":"edge","weights":"smooth","weight_bits":12,"lods":[]})");
  EXPECT_EQ(store.unfinished_jobs().size(), version >= 4 ? 2U : 1U) << "they are taken up again";
  const auto streams = store.streams();
  ASSERT_EQ(streams.size(), 1U);
  EXPECT_EQ(streams[0].settings.title, "Talk");
  EXPECT_EQ(streams[0].settings.viseme_share, version >= 5 ? std::optional(0.25) : std::nullopt);
  EXPECT_EQ(streams[0].settings.batch_interval, version >= 6 ? 40 : 100);
  EXPECT_EQ(streams[0].settings.quantizer_scale, version >= 8 ? 0.5 : 1.0);
  EXPECT_GT(store.identity().starts, 0U) << "it is not new";
  auto hashes = store.referenced_hashes();
  EXPECT_EQ(hashes.size(), version >= 4 ? 7U : 6U) << "no start takes a file for unknown";
  if (version >= 4) {
    EXPECT_EQ(store.job("job-e")->request, R"({"name":"smile","expression_sha256":")" + hash_of('9') + R"("})");
    EXPECT_EQ(store.set("smile")->name, "Smile");
    EXPECT_EQ(store.worn_sets("face").size(), 1U);
  }
  if (version >= 7) {
    EXPECT_EQ(store.recording("aaaaaaaaaaaa")->frames, 25U);
    EXPECT_EQ(store.recording("aaaaaaaaaaaa")->sound_packets, std::nullopt) << "none of these versions counted";
  }
  if (version >= 11) {
    EXPECT_EQ(store.tokens().size(), 1U);
    EXPECT_TRUE(streams[0].settings.is_public);
  }
  if (version >= 13) {
    EXPECT_EQ(store.speech("ssssssssssss")->text, "Hi.");
  }
  const std::string owner = version >= 12 ? "abcdefgh2345" : "";
  EXPECT_EQ(face->owner, owner);
  EXPECT_EQ(streams[0].owner, owner);
  EXPECT_EQ(store.job("job-p")->origin, (Origin{owner, version >= 12 ? "r1" : ""}));
  const auto usage = store.usage_of(owner);
  EXPECT_EQ(usage.models, 2U);
  EXPECT_EQ(usage.recordings, version >= 7 ? 1U : 0U);
  EXPECT_EQ(usage.bytes, version >= 7   ? 376U
                         : version >= 4 ? 76U
                                        : 61U)
      << "six artefacts, a set of 15 bytes, a recording of 300";
}

TEST_F(MigrationTest, EveryEarlierVersion_OpensWithAllItHad_AndIsAsANewOne) {
  const int newest_version = newest();
  const auto schema = Raw(folder_ / "new.sqlite").schema();
  ASSERT_GE(newest_version, 10);
  for (const int version : versions(newest_version)) {
    SCOPED_TRACE("version " + std::to_string(version));
    make(version);
    if (HasFatalFailure()) return;
    for (const bool again : {false, true}) {
      SCOPED_TRACE(again ? "opened again" : "migrated");
      const auto store = open_sqlite_store(file_of(version));
      ASSERT_TRUE(store) << store.error().message;
      expect_all_there(**store, version);
    }
    Raw raw(file_of(version));
    EXPECT_EQ(raw.schema(), schema);
    EXPECT_EQ(raw.values("PRAGMA user_version")[0], std::to_string(newest_version));
    EXPECT_EQ(raw.values("PRAGMA integrity_check"), std::vector<std::string>{"ok"});
    EXPECT_EQ(raw.values("PRAGMA foreign_key_check"), std::vector<std::string>{});
  }
}

TEST_F(MigrationTest, MigratedDatabase_CanBeChanged) {
  const int newest_version = newest();
  for (const int version : versions(newest_version)) {
    SCOPED_TRACE("version " + std::to_string(version));
    make(version);
    if (HasFatalFailure()) return;
    const auto store = open_sqlite_store(file_of(version));
    ASSERT_TRUE(store);
    EXPECT_TRUE((*store)->edit_model("face", "Renamed", {{1, "right_eye"}}, (*store)->model("face")->revision));
    auto job = *(*store)->job("job-n");
    job.state = JobState::failed;
    (*store)->finish_failed_import(job);
    EXPECT_EQ((*store)->model("new")->state, ModelState::failed);
    // All but the files of another job of the model, if there is one, are free.
    const auto orphans = (*store)->remove_model("face");
    ASSERT_TRUE(orphans);
    EXPECT_EQ(orphans->size(), version >= 4 ? 6U : 5U);
    EXPECT_FALSE((*store)->job("job-p")) << "with its model";
  }
}

/// A migration that fails leaves the database as it was, for the program that wrote it.
TEST_F(MigrationTest, MigrationThatFails_ChangesNothing) {
  make(3);
  if (HasFatalFailure()) return;
  std::vector<std::string> before;
  {
    Raw raw(file_of(3));
    raw.execute("CREATE TABLE worn_sets(in_the_way TEXT)");
    before = raw.values("SELECT sql FROM sqlite_master ORDER BY name");
  }
  EXPECT_FALSE(open_sqlite_store(file_of(3)));
  Raw raw(file_of(3));
  EXPECT_EQ(raw.values("SELECT sql FROM sqlite_master ORDER BY name"), before);
  EXPECT_EQ(raw.values("PRAGMA user_version")[0], "3");
  EXPECT_EQ(raw.values("SELECT count(*) FROM jobs")[0], "3");
}

}  // namespace
}  // namespace semblante::store

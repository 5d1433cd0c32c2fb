#include <sqlite3.h>

#include <gtest/gtest.h>

#include "tests/unit/store/store_fixture.h"

namespace semblante::store {
namespace {

TEST_F(StoreTest, Frame_OutlivesReopening_AndAnOldStoreHasNone) {
  import(add("m"));
  EXPECT_EQ(store_->model("m")->frame, std::nullopt) << "facts without a frame are those of an older program";
  // The columns of the tilt: a rotation about Z whose sine and cosine are no decimals of a few digits.
  const glm::dmat3 tilt(0.8775825618903728, 0.479425538604203, 0.0, -0.479425538604203, 0.8775825618903728, 0.0, 0.0,
                        0.0, 1.0);
  const ModelFrame frame{{Direction::plus_z, Direction::minus_y}, true, LengthUnit::inch, false, {"a reason"}, tilt};
  const FrameWish wish{std::nullopt, Direction::plus_z, std::nullopt};
  const auto revision = store_->model("m")->revision;
  EXPECT_FALSE(store_->edit_frame("m", wish, frame, std::nullopt, revision + 1));
  ASSERT_TRUE(store_->edit_frame("m", wish, frame, std::nullopt, revision));
  reopen();
  const auto model = store_->model("m");
  EXPECT_EQ(model->frame, frame);
  EXPECT_EQ(model->frame_wish, wish);
  EXPECT_EQ(model->state, ModelState::ready);
}

TEST_F(StoreTest, SecondImport_TurnsMarkedPositions_KeepsRolesAndWish_DropsThePackage) {
  auto job = add("m");
  import(job);
  ASSERT_TRUE(store_->edit_model("m", std::nullopt, {{1, "right_eye"}}, store_->model("m")->revision));
  ASSERT_TRUE(store_->put_feature_points("m", {{"2.1", 3, std::nullopt}, {"7.1", std::nullopt, {{1.0, 2.0, 3.0}}}}, 0));
  ASSERT_TRUE(store_->finish_parametrization(job, {"p", "now", "edge", "paper", 12, {}}, {}, {}, std::nullopt,
                                             {{"mesh.drc", std::string(64, 'd'), 5, "x"}}, {}));
  const FrameWish wish{std::nullopt, Direction::plus_z, std::nullopt};
  job.id = "second";
  job.state = JobState::queued;
  ASSERT_TRUE(store_->edit_frame("m", wish, {}, job, store_->model("m")->revision));
  EXPECT_EQ(store_->model("m")->state, ModelState::importing);
  EXPECT_TRUE(store_->artefact("m", "mesh.drc")) << "what is there stays until the new import is";

  ModelRecord facts;
  facts.parts = {{"face", "skin", false, 8, 4, {}, {}, 0}, {"eye", "left_eye", false, 4, 2, {}, {}, 1}};
  facts.frame = ModelFrame{{Direction::plus_z, Direction::minus_y}, true, LengthUnit::metre, true, {}};
  job.state = JobState::done;
  // Up from +Z: x stays, y is what was z, z is what was -y.
  const auto freed = store_->finish_import(job, facts, {{"preview.glb", std::string(64, 'e'), 5, "x"}},
                                           Turn{1, 0, 0, 0, 0, 1, 0, -1, 0});
  ASSERT_TRUE(freed);
  EXPECT_EQ(freed->size(), 3U) << "the old preview, the report and the mesh";
  const auto model = store_->model("m");
  EXPECT_EQ(model->state, ModelState::ready);
  EXPECT_EQ(model->package, std::nullopt);
  EXPECT_EQ(model->frame_wish, wish);
  EXPECT_EQ(model->parts[1].role, "right_eye");
  EXPECT_EQ(model->feature_points_revision, 2U);
  const auto points = store_->feature_points("m");
  EXPECT_EQ(points[0].vertex, 3U);
  EXPECT_EQ(points[0].position, std::nullopt);
  EXPECT_EQ(points[1].position, (std::array<double, 3>{1.0, 3.0, -2.0}));
  EXPECT_FALSE(store_->artefact("m", "mesh.drc"));
  EXPECT_TRUE(store_->artefact("m", "source"));
}

TEST_F(StoreTest, FailedImport_FailsItsModel) {
  auto job = add("m");
  job.state = JobState::failed;
  job.problem = R"({"type":"/problems/malformed-model"})";
  store_->finish_failed_import(job);
  EXPECT_EQ(store_->model("m")->state, ModelState::failed);
  EXPECT_EQ(store_->model("m")->problem, job.problem);
}

TEST_F(StoreTest, FailedImportAnew_LeavesTheModelAsItWas) {
  import(add("m"));
  JobRecord job;
  job.id = "again";
  job.model = "m";
  job.state = JobState::cancelled;
  job.problem = R"({"type":"/problems/cancelled"})";
  ASSERT_TRUE(store_->edit_frame("m", {}, {}, job, store_->model("m")->revision));
  EXPECT_EQ(store_->model("m")->state, ModelState::importing);
  store_->finish_failed_import(job);
  EXPECT_EQ(store_->model("m")->state, ModelState::ready);
  EXPECT_EQ(store_->model("m")->problem, "");
  EXPECT_EQ(store_->job("again")->problem, job.problem);
}

TEST_F(StoreTest, LevelsAndWhatWasAskedFor_AreKept) {
  import(add("m"));
  for (const std::string request : {"{}", R"({"lods":[10000,5000]})"}) {
    JobRecord job;
    job.id = random_id();
    job.model = "m";
    job.kind = "parametrize";
    job.request = request;
    store_->create_job(job, {}, std::nullopt);
    reopen();
    EXPECT_EQ(store_->job(job.id)->request, request);
    PackageRecord package;
    package.parametrization = job.id;
    package.levels = {{26719, 52220}, {9998, 17000}};
    ASSERT_TRUE(store_->finish_parametrization(job, package, {}, {}, std::nullopt, {}, {}));
    EXPECT_EQ(store_->model("m")->package, package);
  }
}

TEST_F(StoreTest, AStoreOfBeforeThereWereLevels_Opens) {
  import(add("m"));
  JobRecord job;
  job.id = "p";
  job.model = "m";
  job.kind = "parametrize";
  store_->create_job(job, {}, std::nullopt);
  ASSERT_TRUE(store_->finish_parametrization(job, PackageRecord{"p", "now", "edge", "paper", 12, {}}, {}, {},
                                             std::nullopt, {}, {}));
  store_.reset();
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder_ / "facts.sqlite").c_str(), &database), SQLITE_OK);
  EXPECT_EQ(
      sqlite3_exec(database,
                   "DROP TABLE speech_files; DROP TABLE speeches; "
                   "DROP INDEX models_by_owner; ALTER TABLE models DROP COLUMN owner; "
                   "DROP INDEX streams_by_owner; ALTER TABLE streams DROP COLUMN owner; "
                   "DROP INDEX unfinished_jobs_by_owner; ALTER TABLE jobs DROP COLUMN owner; "
                   "ALTER TABLE jobs DROP COLUMN request_id; "
                   "DROP TABLE tokens; ALTER TABLE streams DROP COLUMN is_public; "
                   "DROP TABLE job_files; DROP TABLE worn_sets; DROP TABLE displacement_sets; "
                   "ALTER TABLE packages DROP COLUMN levels; "
                   "DROP INDEX jobs_by_model; ALTER TABLE jobs DROP COLUMN kind; ALTER TABLE jobs DROP COLUMN request; "
                   "ALTER TABLE jobs ADD COLUMN kind INTEGER NOT NULL DEFAULT 1; "
                   "ALTER TABLE jobs ADD COLUMN metric TEXT NOT NULL DEFAULT 'edge'; "
                   "ALTER TABLE jobs ADD COLUMN weights TEXT NOT NULL DEFAULT 'paper'; "
                   "ALTER TABLE jobs ADD COLUMN weight_bits INTEGER NOT NULL DEFAULT 12; "
                   "ALTER TABLE streams DROP COLUMN viseme_share; "
                   "ALTER TABLE streams DROP COLUMN batch_interval; ALTER TABLE streams DROP COLUMN quantizer_scale; "
                   "DROP TABLE recordings; DROP TABLE identity; PRAGMA user_version=2",
                   nullptr, nullptr, nullptr),
      SQLITE_OK);
  sqlite3_close(database);
  reopen();
  EXPECT_TRUE(store_->model("m")->package->levels.empty());
  EXPECT_EQ(store_->job("p")->request, R"({"metric":"edge","weights":"paper","weight_bits":12,"lods":[]})");
  job.id = "q";
  job.request = R"({"lods":[500]})";
  store_->create_job(job, {}, std::nullopt);
  EXPECT_EQ(store_->job("q")->request, job.request);
}

}  // namespace
}  // namespace semblante::store

#include <sqlite3.h>

#include <gtest/gtest.h>

#include "server/store/facts_json.h"
#include "tests/unit/store/store_fixture.h"

namespace semblante::store {
namespace {

TEST_F(StoreTest, Streams_ComeBackWithEverySetting_InTheirOrder) {
  const StreamRecord set{"talk", "then", {"Talk", "head", 0.25, 40, 0.125}};
  const StreamRecord usual{"a", "later", {}};
  for (const auto& stream : {set, usual}) EXPECT_TRUE(store_->create_stream(stream, std::nullopt));
  EXPECT_FALSE(store_->create_stream({"talk", "again", {}}, std::nullopt)) << "the id is taken";
  reopen();
  EXPECT_EQ(store_->streams(), (std::vector<StreamRecord>{set, usual}));
  EXPECT_TRUE(store_->remove_stream("talk"));
  EXPECT_EQ(store_->streams(), std::vector<StreamRecord>{usual});
}

TEST_F(StoreTest, Recordings_StayWhenTheirStreamGoes) {
  EXPECT_TRUE(store_->create_stream({"talk", timestamp_now(), {}}, std::nullopt));
  const auto made = [](const std::string& id, const std::string& stream) {
    RecordingRecord recording;
    recording.id = id;
    recording.stream = stream;
    recording.name = "Of " + stream;
    recording.model = "head";
    recording.created = timestamp_now();
    return recording;
  };
  auto first = made("r1", "talk");
  first.epoch = 1'750'000'000'000;
  first.max_duration = 60'000;
  const auto second = made("r2", "talk");
  const auto other = made("r3", "walk");
  for (const auto& recording : {first, second, other}) store_->create_recording(recording, std::nullopt);
  EXPECT_TRUE(store_->remove_stream("talk"));
  first.state = RecordingState::finished;
  first.ended = "stopped";
  first.duration = 5000;
  first.frames = 120;
  first.lost = 3;
  first.bytes = 9000;
  first.media_time = 777;
  first.sound_packets = 40;
  store_->finish_recording(first);
  reopen();
  EXPECT_EQ(store_->recording("r1"), first);
  EXPECT_EQ(store_->newest_recording("talk"), second);
  EXPECT_EQ(store_->newest_recording("nobody"), std::nullopt);
  EXPECT_EQ(*store_->recordings("", "", 10), (std::vector<RecordingRecord>{first, second, other}));
  EXPECT_EQ(*store_->recordings("talk", "r1", 10), std::vector<RecordingRecord>{second});
  EXPECT_EQ(*store_->recordings("", "r1", 1), std::vector<RecordingRecord>{second});
  EXPECT_EQ(store_->recordings("", "nobody", 1), std::nullopt);
  EXPECT_EQ(store_->recording_count(), 3U);
  EXPECT_TRUE(store_->remove_recording("r1"));
  EXPECT_FALSE(store_->remove_recording("r1"));
}

TEST_F(StoreTest, Model_ComesBackAfterReopening) {
  import(add("m"));
  const auto before = store_->model("m");
  ASSERT_TRUE(before);
  EXPECT_EQ(before->state, ModelState::ready);
  EXPECT_EQ(before->parts.size(), 2U);
  EXPECT_EQ(before->box_max[2], 0.1);
  EXPECT_EQ(before->findings, (FindingCounts{1, 2, 3}));
  reopen();
  EXPECT_EQ(store_->model("m"), before);
  EXPECT_FALSE(store_->model("n"));
}

TEST_F(StoreTest, TakenId_IsRefusedWhole) {
  const auto job = add("m");
  ModelRecord again;
  again.id = "m";
  JobRecord other;
  other.id = "other";
  other.model = "m";
  EXPECT_FALSE(store_->create_model(again, {"source", std::string(64, 'c'), 1, ""}, other, std::nullopt));
  EXPECT_FALSE(store_->job("other"));
  EXPECT_EQ(store_->job(job.id), job);
}

TEST_F(StoreTest, FeaturePoints_NeedTheRightRevision) {
  add("m");
  const std::vector<FeaturePointRecord> points = {{"2.1", 5, std::nullopt}, {"7.1", std::nullopt, {{0.1, -2.0, 3e-9}}}};
  EXPECT_TRUE(store_->put_feature_points("m", points, 0));
  EXPECT_FALSE(store_->put_feature_points("m", {}, 0)) << "somebody else was quicker";
  EXPECT_EQ(store_->feature_points("m"), points);
  EXPECT_EQ(store_->model("m")->feature_point_count, 2U);
  EXPECT_TRUE(store_->put_feature_points("m", {}, 1));
  EXPECT_TRUE(store_->feature_points("m").empty());
  EXPECT_FALSE(store_->put_feature_points("absent", {}, 0));
}

TEST_F(StoreTest, Proposals_FillWhatIsNotPlacedAndReplaceEarlierOnes) {
  JobRecord job = add("m");
  const FeaturePointRecord placed = {"2.1", 5, std::nullopt};
  const FeaturePointRecord earlier = {"2.2", 6, std::nullopt, ProposalRecord{"shape", "low", 0.25}};
  ASSERT_TRUE(store_->put_feature_points("m", {placed, earlier}, 0));
  const ProposalRecord how{"mirror", "high", 0.03125, "joined lips"};
  const std::vector<FeaturePointRecord> proposals = {
      {"2.1", 7, std::nullopt, how}, {"11.1", 8, std::nullopt, how}, {"7.1", std::nullopt, {{0.0, 1.0, 2.0}}, how}};
  job.state = JobState::done;
  job.result = "{}";
  EXPECT_TRUE(store_->finish_proposal(job, proposals));
  reopen();
  // In rising order, which is not that of the letters.
  EXPECT_EQ(store_->feature_points("m"), (std::vector<FeaturePointRecord>{placed, proposals[2], proposals[1]}));
  EXPECT_EQ(store_->model("m")->feature_points_revision, 2U);
  EXPECT_EQ(store_->job(job.id), job);
  EXPECT_FALSE(store_->put_feature_points("m", {}, 1)) << "an edit from before the proposals";
  job.model = "absent";
  EXPECT_FALSE(store_->finish_proposal(job, proposals));
}

TEST_F(StoreTest, StoreOfTheFirstVersion_OpensWithItsPointsPlaced) {
  store_.reset();
  std::filesystem::remove(folder_ / "facts.sqlite");
  std::filesystem::remove(folder_ / "facts.sqlite-wal");
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder_ / "facts.sqlite").c_str(), &database), SQLITE_OK);
  // As version 1 made and filled it.
  const char* const sql = R"sql(
    CREATE TABLE models(
      number INTEGER PRIMARY KEY AUTOINCREMENT,
      id TEXT NOT NULL UNIQUE, name TEXT NOT NULL, state INTEGER NOT NULL, problem TEXT NOT NULL,
      created TEXT NOT NULL, updated TEXT NOT NULL, revision INTEGER NOT NULL,
      file_name TEXT NOT NULL, format TEXT NOT NULL, source_bytes INTEGER NOT NULL, source_sha256 TEXT NOT NULL,
      vertices INTEGER NOT NULL, triangles INTEGER NOT NULL, facts TEXT NOT NULL,
      points_revision INTEGER NOT NULL) STRICT;
    CREATE TABLE packages(
      model TEXT PRIMARY KEY REFERENCES models(id) ON DELETE CASCADE,
      parametrization TEXT NOT NULL, created TEXT NOT NULL, metric TEXT NOT NULL, weights TEXT NOT NULL,
      weight_bits INTEGER NOT NULL) STRICT;
    CREATE TABLE feature_points(
      model TEXT NOT NULL REFERENCES models(id) ON DELETE CASCADE, position INTEGER NOT NULL, id TEXT NOT NULL,
      vertex INTEGER, x REAL, y REAL, z REAL, PRIMARY KEY(model, id)) STRICT, WITHOUT ROWID;
    CREATE TABLE artefacts(
      model TEXT NOT NULL REFERENCES models(id) ON DELETE CASCADE, name TEXT NOT NULL, sha256 TEXT NOT NULL,
      bytes INTEGER NOT NULL, content_type TEXT NOT NULL, of_package INTEGER NOT NULL,
      PRIMARY KEY(model, name)) STRICT, WITHOUT ROWID;
    CREATE TABLE jobs(
      number INTEGER PRIMARY KEY AUTOINCREMENT,
      id TEXT NOT NULL UNIQUE, model TEXT NOT NULL REFERENCES models(id) ON DELETE CASCADE,
      kind INTEGER NOT NULL, state INTEGER NOT NULL, progress REAL NOT NULL, stage TEXT NOT NULL,
      created TEXT NOT NULL, updated TEXT NOT NULL, problem TEXT NOT NULL,
      metric TEXT NOT NULL, weights TEXT NOT NULL, weight_bits INTEGER NOT NULL, attempts INTEGER NOT NULL) STRICT;
    CREATE TABLE streams(
      number INTEGER PRIMARY KEY AUTOINCREMENT,
      id TEXT NOT NULL UNIQUE, title TEXT NOT NULL, model TEXT NOT NULL, created TEXT NOT NULL) STRICT;
    CREATE TABLE idempotency(
      key TEXT PRIMARY KEY, fingerprint TEXT NOT NULL, resource TEXT NOT NULL, created TEXT NOT NULL) STRICT;
    INSERT INTO models VALUES(1,'m','Ana',1,'','t','t',3,'a.obj','obj',1,'s',8,4,'{}',1);
    INSERT INTO feature_points VALUES('m',0,'2.1',5,NULL,NULL,NULL);
    INSERT INTO jobs VALUES(1,'j','m',1,2,1.0,'done','t','t','','edge','paper',12,1);
    PRAGMA user_version=1)sql";
  ASSERT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
  sqlite3_close(database);
  reopen();
  EXPECT_EQ(store_->feature_points("m"), (std::vector<FeaturePointRecord>{{"2.1", 5, std::nullopt}}));
  ASSERT_TRUE(store_->job("j"));
  EXPECT_EQ(store_->job("j")->result, "");
  EXPECT_TRUE(store_->put_feature_points("m", {{"2.1", 5, std::nullopt, ProposalRecord{"shape", "low", 0.5}}}, 1));
  EXPECT_TRUE(store_->feature_points("m")[0].proposal);
  EXPECT_EQ(store_->identity().starts, 1U) << "it has been worked with";
  reopen();
  EXPECT_TRUE(store_->feature_points("m")[0].proposal) << "and opens again";
}

TEST_F(StoreTest, UserRole_OutlivesTheGuess) {
  import(add("m"));
  const auto revision = store_->model("m")->revision;
  EXPECT_FALSE(store_->edit_model("m", "x", {}, revision + 1));
  EXPECT_FALSE(store_->edit_model("m", std::nullopt, {{9, "skin"}}, revision)) << "no such part";
  ASSERT_TRUE(store_->edit_model("m", "Renamed", {{1, "right_eye"}}, revision));
  JobRecord job;
  job.id = "p";
  job.model = "m";
  job.kind = "parametrize";
  store_->create_job(job, {}, std::nullopt);
  job.state = JobState::done;
  std::vector<PartRecord> guesses = {{"face", "attached", false, 8, 4, {}, {}, 0},
                                     {"eye", "left_eye", false, 4, 2, {}, {}, 1}};
  ASSERT_TRUE(store_->finish_parametrization(job, {"p", "now", "edge", "paper", 12, {}}, guesses, {}, std::nullopt,
                                             {{"mesh.drc", std::string(64, 'd'), 3, "x"}}, {}));
  const auto model = *store_->model("m");
  EXPECT_EQ(model.name, "Renamed");
  EXPECT_EQ(model.parts[0].role, "attached");
  EXPECT_EQ(model.parts[1].role, "right_eye");
  EXPECT_EQ(model.state, ModelState::parametrized);
  EXPECT_EQ(model.package->parametrization, "p");
}

TEST_F(StoreTest, NewPackage_GivesTheOldHashesFree) {
  import(add("m"));
  const auto finish = [&](const std::string& id, char hash) {
    JobRecord job;
    job.id = id;
    job.model = "m";
    job.kind = "parametrize";
    store_->create_job(job, {}, std::nullopt);
    return *store_->finish_parametrization(job, {id, "now", "edge", "paper", 12, {}}, {}, {}, std::nullopt,
                                           {{"mesh.drc", std::string(64, hash), 3, "x"}}, {});
  };
  EXPECT_TRUE(finish("one", 'd').empty());
  EXPECT_TRUE(finish("two", 'd').empty()) << "the same bytes are still in use";
  EXPECT_EQ(finish("three", 'e'), std::vector<std::string>{std::string(64, 'd')});
  EXPECT_TRUE(store_->public_artefact(std::string(64, 'e')));
  EXPECT_FALSE(store_->public_artefact(std::string(64, 'a'))) << "uploads are not for everyone";
}

TEST_F(StoreTest, ReportOfTheParametrization_ReplacesThatOfTheImport) {
  import(add("m"));
  JobRecord job;
  job.id = "p";
  job.model = "m";
  job.kind = "parametrize";
  store_->create_job(job, {}, std::nullopt);
  const auto freed = store_->finish_parametrization(job, {"p", "now", "edge", "paper", 12, {}}, {}, {}, FindingCounts{},
                                                    {{"report.json", std::string(64, 'e'), 3, "application/json"}}, {});
  EXPECT_EQ(freed, std::vector<std::string>{std::string(64, 'c')});
  EXPECT_EQ(store_->artefact("m", "report.json")->sha256, std::string(64, 'e'));
  EXPECT_TRUE(store_->artefact("m", "preview.glb"));
  EXPECT_EQ(store_->model("m")->findings, FindingCounts{});
}

TEST_F(StoreTest, FactsWithoutFindings_AreOfAModelNeverExamined) {
  ModelRecord model;
  model.findings = FindingCounts{};
  read_facts(R"({"min":[0,0,0],"max":[1,1,1],"warnings":["w"],"parts":[]})", model);
  EXPECT_EQ(model.warnings.size(), 1U);
  EXPECT_FALSE(model.findings);
}

TEST_F(StoreTest, RemovedModel_TakesEverythingButSharedBytes) {
  import(add("m", std::string(64, 'a')));
  add("n", std::string(64, 'a'));
  EXPECT_EQ(store_->remove_model("m"), (std::vector{std::string(64, 'b'), std::string(64, 'c')}))
      << "the source is n's too";
  EXPECT_FALSE(store_->job("job-m"));
  EXPECT_TRUE(store_->artefacts("m").empty());
  EXPECT_FALSE(store_->remove_model("m"));
}

TEST_F(StoreTest, Pages_GoInTheOrderOfCreation) {
  for (const auto* id : {"c", "a", "b"}) add(id);
  const auto first = store_->models("", 2);
  ASSERT_EQ(first->size(), 2U);
  EXPECT_EQ((*first)[1].id, "a");
  EXPECT_EQ(store_->models("a", 2)->at(0).id, "b");
  EXPECT_FALSE(store_->models("absent", 2));
}

TEST_F(StoreTest, UnfinishedJobs_AreThoseToTakeUpAgain) {
  auto done = add("a");
  auto running = add("b");
  const auto queued = add("c");
  done.state = JobState::done;
  store_->update_job(done);
  running.state = JobState::running;
  running.attempts = 2;
  store_->update_job(running);
  reopen();
  EXPECT_EQ(store_->unfinished_jobs(), (std::vector<JobRecord>{running, queued}));
}

TEST_F(StoreTest, LaterVersionOfTheFile_IsRefused) {
  store_.reset();
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder_ / "facts.sqlite").c_str(), &database), SQLITE_OK);
  sqlite3_exec(database, "PRAGMA user_version=99", nullptr, nullptr, nullptr);
  sqlite3_close(database);
  const auto opened = open_sqlite_store(folder_ / "facts.sqlite");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::unsupported);
}

TEST_F(StoreTest, Identity_StaysAndCountsStarts_AndEachDatabaseHasItsOwn) {
  const auto made = store_->identity();
  EXPECT_EQ(made.starts, 0U) << "nobody has worked with it";
  EXPECT_EQ(made.id.size(), 32U);
  EXPECT_EQ(store_->count_start(), (DatabaseIdentity{made.id, 1}));
  reopen();
  EXPECT_EQ(store_->identity(), (DatabaseIdentity{made.id, 1}));
  const auto other = open_sqlite_store(folder_ / "other.sqlite");
  EXPECT_NE((*other)->identity().id, made.id);
}

TEST_F(StoreTest, UsersOfAHash_AreModelsAndJobs) {
  add("m");
  add("n");
  JobRecord job;
  job.id = "x";
  job.kind = "extract";
  store_->create_job(job, {std::string(64, 'a')}, std::nullopt);
  EXPECT_EQ(store_->users_of(std::string(64, 'a')), (std::vector<std::string>{"job x", "model m", "model n"}));
  EXPECT_TRUE(store_->users_of(std::string(64, 'b')).empty());
}

TEST_F(StoreTest, UsageOfAnOwner_CountsWhatItsRequestsMade_AndStillIsThere) {
  const auto add_model = [&](const std::string& id, const std::string& owner, const std::string& hash) {
    ModelRecord model;
    model.id = id;
    model.owner = owner;
    JobRecord job;
    job.id = "import-" + id;
    job.model = id;
    job.kind = "import";
    job.origin = {owner, "request"};
    ASSERT_TRUE(store_->create_model(model, {"source", hash, 100, "application/octet-stream"}, job, std::nullopt));
  };
  const std::string hash(64, 'a'), other(64, 'b');
  add_model("m1", "ana", hash);
  add_model("m2", "ana", hash);
  add_model("m3", "ana", other);
  add_model("m4", "bob", hash);
  EXPECT_EQ(store_->usage_of("ana"), (Usage{.bytes = 200, .models = 3, .jobs = 3})) << "each content once";
  EXPECT_EQ(store_->usage_of("bob"), (Usage{.bytes = 100, .models = 1, .jobs = 1}));
  EXPECT_EQ(store_->usage_of("eve"), Usage{});

  SetRecord set;
  set.id = "set";
  set.displacements = "{\"é\":1}";
  set.owner = "eve";
  store_->create_set(set, std::nullopt);
  JobRecord extraction;
  extraction.id = "extraction";
  extraction.kind = "extract";
  extraction.origin.owner = "eve";
  store_->create_job(extraction, {}, std::nullopt);
  EXPECT_TRUE(store_->create_stream({"talk", timestamp_now(), {}, "eve"}, std::nullopt));
  RecordingRecord recording;
  recording.id = "take";
  recording.bytes = 1000;
  recording.owner = "eve";
  store_->create_recording(recording, std::nullopt);
  EXPECT_EQ(store_->usage_of("eve"), (Usage{.bytes = 1008, .sets = 2, .streams = 1, .recordings = 1, .jobs = 1}))
      << "the set that the extraction will make, and the bytes of the UTF-8";
  EXPECT_EQ(store_->set("set")->owner, "eve");
  EXPECT_EQ(store_->recording("take")->owner, "eve");
  EXPECT_EQ(store_->streams().back().owner, "eve");

  extraction.state = JobState::failed;
  store_->finish_job(extraction);
  store_->remove_set("set");
  store_->remove_stream("talk");
  store_->remove_recording("take");
  EXPECT_EQ(store_->usage_of("eve"), Usage{});
  ASSERT_TRUE(store_->remove_model("m1"));
  ASSERT_TRUE(store_->remove_model("m3"));
  EXPECT_EQ(store_->usage_of("ana"), (Usage{.bytes = 100, .models = 1, .jobs = 1}));
}

}  // namespace
}  // namespace semblante::store

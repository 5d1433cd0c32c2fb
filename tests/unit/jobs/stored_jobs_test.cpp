// Jobs in a data folder that was written when each kind had columns of its own.
#include <cstdlib>
#include <filesystem>
#include <sqlite3.h>

#include <gtest/gtest.h>

#include "server/jobs/job.h"
#include "server/store/sqlite_store.h"

namespace semblante::jobs {
namespace {

/// As version 9 made it.
constexpr const char* const version_9 = R"sql(
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
  weight_bits INTEGER NOT NULL, levels TEXT NOT NULL DEFAULT '[]') STRICT;
CREATE TABLE feature_points(
  model TEXT NOT NULL REFERENCES models(id) ON DELETE CASCADE, position INTEGER NOT NULL, id TEXT NOT NULL,
  vertex INTEGER, x REAL, y REAL, z REAL, proposal TEXT, PRIMARY KEY(model, id)) STRICT, WITHOUT ROWID;
CREATE TABLE artefacts(
  model TEXT NOT NULL REFERENCES models(id) ON DELETE CASCADE, name TEXT NOT NULL, sha256 TEXT NOT NULL,
  bytes INTEGER NOT NULL, content_type TEXT NOT NULL, of_package INTEGER NOT NULL,
  PRIMARY KEY(model, name)) STRICT, WITHOUT ROWID;
CREATE INDEX artefacts_by_hash ON artefacts(sha256);
CREATE TABLE streams(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, title TEXT NOT NULL, model TEXT NOT NULL, created TEXT NOT NULL,
  viseme_share REAL, batch_interval INTEGER NOT NULL DEFAULT 100, quantizer_scale REAL NOT NULL DEFAULT 1) STRICT;
CREATE TABLE idempotency(
  key TEXT PRIMARY KEY, fingerprint TEXT NOT NULL, resource TEXT NOT NULL, created TEXT NOT NULL) STRICT;
CREATE TABLE "jobs"(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, model TEXT REFERENCES models(id) ON DELETE CASCADE,
  kind INTEGER NOT NULL, state INTEGER NOT NULL, progress REAL NOT NULL, stage TEXT NOT NULL,
  created TEXT NOT NULL, updated TEXT NOT NULL, problem TEXT NOT NULL,
  metric TEXT NOT NULL, weights TEXT NOT NULL, weight_bits INTEGER NOT NULL, attempts INTEGER NOT NULL,
  result TEXT NOT NULL, lods TEXT NOT NULL, extraction TEXT NOT NULL) STRICT;
CREATE INDEX jobs_by_model ON jobs(model, kind);
CREATE TABLE job_files(
  job TEXT NOT NULL REFERENCES jobs(id) ON DELETE CASCADE, sha256 TEXT NOT NULL,
  PRIMARY KEY(job, sha256)) STRICT, WITHOUT ROWID;
CREATE INDEX job_files_by_hash ON job_files(sha256);
CREATE TABLE displacement_sets(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, name TEXT NOT NULL, kind TEXT NOT NULL, revision INTEGER NOT NULL,
  created TEXT NOT NULL, updated TEXT NOT NULL, displacements TEXT NOT NULL, source TEXT NOT NULL) STRICT;
CREATE TABLE worn_sets(
  model TEXT NOT NULL REFERENCES models(id) ON DELETE CASCADE, slot TEXT NOT NULL,
  displacement_set TEXT NOT NULL, name TEXT NOT NULL, revision INTEGER NOT NULL, displacements TEXT NOT NULL,
  PRIMARY KEY(model, slot)) STRICT, WITHOUT ROWID;
CREATE TABLE recordings(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, stream TEXT NOT NULL, name TEXT NOT NULL, model TEXT NOT NULL, created TEXT NOT NULL,
  state INTEGER NOT NULL, ended TEXT NOT NULL, duration INTEGER NOT NULL, frames INTEGER NOT NULL,
  lost INTEGER NOT NULL, bytes INTEGER NOT NULL, epoch INTEGER NOT NULL, media_time INTEGER NOT NULL,
  max_duration INTEGER) STRICT;
CREATE INDEX recordings_by_stream ON recordings(stream);
CREATE TABLE identity(id TEXT NOT NULL, starts INTEGER NOT NULL) STRICT;
PRAGMA user_version=9;
)sql";

/// As its programs filled it.
constexpr const char* const rows = R"sql(
INSERT INTO identity VALUES('0123',3);
INSERT INTO models VALUES(1,'m','Ana',2,'','t','t',3,'a.obj','obj',1,'s',8,4,'{}',1);
INSERT INTO jobs VALUES(1,'import','m',0,2,1.0,'done','t1','t2','','edge','paper',12,1,'','[]','');
INSERT INTO jobs VALUES(2,'package','m',1,2,1.0,'done','t1','t2','','unfolded','smooth',9,2,'','[10000,5000]','');
INSERT INTO jobs VALUES(3,'early','m',1,3,0.5,'rig','t1','t2','{"type":"/problems/worker-limit"}','edge','paper',12,1,
  '','','');
INSERT INTO jobs VALUES(4,'points','m',2,2,1.0,'done','t1','t2','','edge','paper',12,1,
  '{"not_proposed":{"6.2":"no tongue"},"proposed":3}','[]','');
INSERT INTO jobs VALUES(5,'set',NULL,3,0,0.0,'','t1','t1','','edge','paper',12,0,'','[]',
  '{"align":true,"expression_file":"smile.obj","expression_sha256":"eee","from":"","kind":"viseme","least":2.5,'
  || '"name":"Grin","neutral_file":"head.obj","neutral_sha256":"ddd","points":[{"id":"2.1","vertex":5}],'
  || '"strength":0.5,"target":""}');
INSERT INTO job_files VALUES('set','ddd'),('set','eee');
)sql";

class StoredJobsTest : public ::testing::Test {
 protected:
  StoredJobsTest() {
    std::string name = (std::filesystem::temp_directory_path() / "semblante-stored-jobs-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    sqlite3* database = nullptr;
    EXPECT_EQ(sqlite3_open((folder_ / "facts.sqlite").c_str(), &database), SQLITE_OK);
    for (const auto* sql : {version_9, rows})
      EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
    reopen();
  }
  ~StoredJobsTest() override {
    store_.reset();
    std::filesystem::remove_all(folder_);
  }
  void reopen() {
    store_.reset();
    auto opened = store::open_sqlite_store(folder_ / "facts.sqlite");
    ASSERT_TRUE(opened) << opened.error().message;
    store_ = std::move(*opened);
  }

  std::filesystem::path folder_;
  std::unique_ptr<store::Store> store_;
};

TEST_F(StoredJobsTest, EveryKind_IsReadAsItWasAskedFor) {
  for (int round = 0; round < 2; ++round) {
    EXPECT_TRUE(read_job_as<ImportJob>(*store_->job("import")));
    EXPECT_EQ(read_job_as<ParametrizeJob>(*store_->job("package")),
              (ParametrizeJob{"unfolded", "smooth", 9, {10000, 5000}}));
    EXPECT_EQ(read_job_as<ParametrizeJob>(*store_->job("early")), ParametrizeJob{}) << "of before there were levels";
    EXPECT_TRUE(read_job_as<ProposeJob>(*store_->job("points")));
    ExtractJob extraction;
    extraction.name = "Grin";
    extraction.kind = "viseme";
    extraction.align = true;
    extraction.least = 2.5;
    extraction.strength = 0.5;
    extraction.expression_file = "smile.obj";
    extraction.expression_sha256 = "eee";
    extraction.neutral_file = "head.obj";
    extraction.neutral_sha256 = "ddd";
    extraction.points = {{"2.1", 5, std::nullopt}};
    EXPECT_EQ(read_job_as<ExtractJob>(*store_->job("set")), extraction);
    EXPECT_FALSE(read_job_as<ImportJob>(*store_->job("set"))) << "it is of another kind";
    reopen();
  }
}

TEST_F(StoredJobsTest, WhatAllJobsHave_StaysAsItWas) {
  const auto early = *store_->job("early");
  EXPECT_EQ(early.kind, "parametrize");
  EXPECT_EQ(early.model, "m");
  EXPECT_EQ(early.state, store::JobState::failed);
  EXPECT_EQ(early.progress, 0.5);
  EXPECT_EQ(early.stage, "rig");
  EXPECT_EQ(early.created, "t1");
  EXPECT_EQ(early.updated, "t2");
  EXPECT_EQ(early.problem, R"({"type":"/problems/worker-limit"})");
  EXPECT_EQ(early.attempts, 1U);
  EXPECT_EQ(store_->job("points")->result, R"({"not_proposed":{"6.2":"no tongue"},"proposed":3})");
  EXPECT_EQ(store_->job("set")->model, "");
}

TEST_F(StoredJobsTest, JobsAreFoundByKind_TakenUpAgain_AndKeepTheirFiles) {
  EXPECT_EQ(store_->latest_job("m", ImportJob::kind_name)->id, "import");
  EXPECT_EQ(store_->latest_job("m", ParametrizeJob::kind_name)->id, "early");
  EXPECT_EQ(store_->latest_job("m", ProposeJob::kind_name)->id, "points");
  EXPECT_FALSE(store_->latest_job("m", ExtractJob::kind_name)) << "it is of no model";
  ASSERT_EQ(store_->unfinished_jobs().size(), 1U);
  auto job = store_->unfinished_jobs().front();
  EXPECT_EQ(store_->referenced_hashes(), (std::vector<std::string>{"ddd", "eee"}));
  job.state = store::JobState::cancelled;
  EXPECT_EQ(finish_without_outcome(job, *store_), (std::vector<std::string>{"ddd", "eee"}));
  EXPECT_TRUE(store_->unfinished_jobs().empty());
  store_->create_job(new_record(ProposeJob{}, "m"), {}, std::nullopt);
  EXPECT_EQ(store_->unfinished_jobs().size(), 1U);
}

}  // namespace
}  // namespace semblante::jobs

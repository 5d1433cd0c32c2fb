#pragma once

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "server/store/sqlite_store.h"

namespace semblante::store {

/// A store in a folder of its own.
class StoreTest : public ::testing::Test {
 protected:
  StoreTest() {
    std::string name = (std::filesystem::temp_directory_path() / "semblante-store-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    reopen();
  }
  ~StoreTest() override { std::filesystem::remove_all(folder_); }

  void reopen() {
    store_.reset();
    auto opened = open_sqlite_store(folder_ / "facts.sqlite");
    ASSERT_TRUE(opened) << opened.error().message;
    store_ = std::move(*opened);
  }

  JobRecord add(const std::string& id, const std::string& hash = std::string(64, 'a')) {
    ModelRecord model;
    model.id = id;
    model.name = "Name of " + id;
    model.source_sha256 = hash;
    model.created = model.updated = timestamp_now();
    JobRecord job;
    job.id = "job-" + id;
    job.model = id;
    job.created = job.updated = model.created;
    EXPECT_TRUE(store_->create_model(model, {"source", hash, 10, "application/octet-stream"}, job, std::nullopt));
    return job;
  }

  void import(JobRecord job) {
    ModelRecord facts;
    facts.format = "obj";
    facts.vertices = 8;
    facts.box_max = {1.0, 2.0, 0.1};
    facts.parts = {{"face", "skin", false, 8, 4, {0, 0, 0}, {1, 1, 1}, 0}, {"eye", "left_eye", false, 4, 2, {}, {}, 1}};
    facts.warnings = {"a warning with \xff bad bytes"};
    facts.findings = FindingCounts{1, 2, 3};
    job.state = JobState::done;
    EXPECT_TRUE(store_->finish_import(job, facts,
                                      {{"preview.glb", std::string(64, 'b'), 5, "model/gltf-binary"},
                                       {"report.json", std::string(64, 'c'), 5, "application/json"}},
                                      std::nullopt));
  }

  std::filesystem::path folder_;
  std::unique_ptr<Store> store_;
};

}  // namespace semblante::store

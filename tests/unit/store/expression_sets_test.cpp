#include <algorithm>

#include <gtest/gtest.h>

#include "tests/unit/store/store_fixture.h"

namespace semblante::store {
namespace {

TEST_F(StoreTest, Sets_AreKeptEditedByRevisionAndRemoved) {
  SetRecord set{"s1", "Grin", "viseme", 1, "t", "t", R"({"2.1":[0,1,0]})", ""};
  IdempotencyRecord key{"key", "print", "s1"};
  store_->create_set(set, key);
  store_->create_set({"s2", "Other", "expression", 1, "t", "t", "{}", "{}"}, std::nullopt);
  reopen();
  EXPECT_EQ(store_->set("s1"), set);
  EXPECT_EQ(store_->idempotency("key"), key);
  EXPECT_EQ(store_->set_count(), 2U);
  EXPECT_EQ(store_->sets("", 1)->front().id, "s1");
  EXPECT_EQ(store_->sets("s1", 5)->front().id, "s2");
  EXPECT_FALSE(store_->sets("absent", 5));

  set.name = "Smile";
  set.displacements = "{}";
  EXPECT_TRUE(store_->put_set(set));
  EXPECT_FALSE(store_->put_set(set)) << "the revision has passed";
  reopen();
  EXPECT_EQ(store_->set("s1")->name, "Smile");
  EXPECT_EQ(store_->set("s1")->revision, 2U);
  EXPECT_TRUE(store_->remove_set("s1"));
  EXPECT_FALSE(store_->remove_set("s1"));
  reopen();
  EXPECT_FALSE(store_->set("s1"));
}

TEST_F(StoreTest, WornSets_StayThroughImportsAndGoWithTheirModel) {
  import(add("m"));
  const auto revision = store_->model("m")->revision;
  const WornSet joy{"joy", "s1", "Grin", 3, R"({"2.1":[0,1,0]})"};
  const WornSet a{"a", "s2", "Ah", 1, "{}"};
  EXPECT_FALSE(store_->edit_worn("m", {joy}, std::nullopt, revision + 1));
  JobRecord job;
  job.id = "p";
  job.model = "m";
  job.kind = "parametrize";
  EXPECT_TRUE(store_->edit_worn("m", {joy, a}, job, revision));
  EXPECT_TRUE(store_->job("p"));
  reopen();
  EXPECT_EQ(store_->worn_sets("m"), (std::vector<WornSet>{a, joy}));
  EXPECT_EQ(store_->model("m")->worn, (std::vector<WornSet>{{"a", "s2", "Ah", 1, ""}, {"joy", "s1", "Grin", 3, ""}}));
  JobRecord again;
  again.id = "again";
  again.model = "m";
  store_->create_job(again, {}, std::nullopt);
  import(again);
  EXPECT_TRUE(store_->edit_worn("m", {{"a", "", "", 1, ""}}, std::nullopt, store_->model("m")->revision));
  EXPECT_EQ(store_->worn_sets("m"), std::vector<WornSet>{joy});
  EXPECT_TRUE(store_->remove_model("m"));
  EXPECT_TRUE(store_->worn_sets("m").empty());
}

TEST_F(StoreTest, Extraction_KeepsItsFilesUntilItEnds) {
  const std::string neutral(64, 'd'), expression(64, 'e');
  JobRecord job;
  job.id = "x";
  job.kind = "extract";
  job.request = R"({"name":"Grin"})";
  store_->create_job(job, {expression, neutral}, std::nullopt);
  reopen();
  EXPECT_EQ(store_->unfinished_jobs(), std::vector<JobRecord>{job});
  EXPECT_EQ(store_->referenced_hashes(), (std::vector<std::string>{neutral, expression}));
  job.state = JobState::done;
  EXPECT_EQ(store_->finish_extraction(job, {"s", "Grin", "viseme", 1, "t", "t", "{}", "{}"}),
            (std::vector<std::string>{neutral, expression}));
  EXPECT_TRUE(store_->set("s"));
  EXPECT_TRUE(store_->referenced_hashes().empty());
  EXPECT_TRUE(store_->finish_job(job).empty());
  EXPECT_TRUE(store_->job("x"));
}

TEST_F(StoreTest, RemovedModel_GivesTheFilesOfItsExtractionsFree) {
  import(add("m"));
  JobRecord job;
  job.id = "x";
  job.model = "m";
  job.kind = "extract";
  store_->create_job(job, {std::string(64, 'e')}, std::nullopt);
  const auto orphans = store_->remove_model("m");
  ASSERT_TRUE(orphans);
  EXPECT_NE(std::find(orphans->begin(), orphans->end(), std::string(64, 'e')), orphans->end());
  EXPECT_FALSE(store_->job("x"));
}

}  // namespace
}  // namespace semblante::store

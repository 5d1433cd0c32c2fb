// What a start does with the files of a data folder: nothing is lost beside a database that does not know it.

#include "server/store/trash.h"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "protocol/hash/sha256.h"
#include "server/log/periodic.h"
#include "server/store/last_database.h"
#include "server/store/reconcile.h"

namespace semblante::store {
namespace {

namespace fs = std::filesystem;
using std::chrono::hours;
using std::chrono::seconds;
using Names = std::unordered_set<std::string>;

const Trash::Time noon = Trash::Time(hours(24 * 20'000 + 12));

class TrashTest : public ::testing::Test {
 protected:
  TrashTest() {
    std::string name = (fs::temp_directory_path() / "semblante-trash-XXXXXX").string();
    data_ = mkdtemp(name.data());
  }
  ~TrashTest() override { fs::remove_all(data_); }

  void write(const fs::path& path, const std::string& text) const {
    fs::create_directories((data_ / path).parent_path());
    std::ofstream(data_ / path, std::ios::binary) << text;
  }
  [[nodiscard]] std::string read(const fs::path& path) const {
    std::ifstream file(data_ / path, std::ios::binary);
    return {(std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>()};
  }
  std::string blob(const std::string& text) const {
    auto hash = sha256_hex(text);
    write(data_file_path(DataFileKind::blob, hash), text);
    return hash;
  }
  std::string recording(const std::string& text) const {
    auto id = random_id();
    write(data_file_path(DataFileKind::recording, id), text);
    return id;
  }
  [[nodiscard]] bool has(DataFileKind kind, const std::string& name) const {
    return is_real_file(data_ / data_file_path(kind, name));
  }
  Reconciled start(DataFileKind kind, const Names& known, Trash::Time now = noon, seconds grace = hours(24)) const {
    Trash trash(data_, grace, now);
    auto result = reconcile(data_, trash, kind, known);
    EXPECT_TRUE(trash.sync());
    return result;
  }
  Trash::Counts purge(Trash::Time now, seconds grace = hours(24)) const {
    return Trash(data_, grace, now).purge(now, {});
  }
  [[nodiscard]] Trash::Counts counts() const { return Trash(data_, hours(24), noon).counts(); }

  fs::path data_;
};

TEST_F(TrashTest, UnknownFiles_AreMovedAndComeBack_ForBlobsAndRecordings) {
  const auto kept = blob("kept");
  const auto lost = blob("lost");
  const auto take = recording("take");
  EXPECT_EQ(start(DataFileKind::blob, {kept}).moved, 1U);
  const auto recordings = start(DataFileKind::recording, {});
  EXPECT_EQ(recordings.moved, 1U);
  EXPECT_EQ(recordings.moved_bytes, 4U);
  EXPECT_TRUE(has(DataFileKind::blob, kept));
  EXPECT_FALSE(has(DataFileKind::blob, lost));
  EXPECT_FALSE(has(DataFileKind::recording, take));
  EXPECT_EQ(read("trash/2024-10-04T12-00-00Z/" + data_file_path(DataFileKind::blob, lost).string()), "lost");
  EXPECT_EQ(read("trash/2024-10-04T12-00-00Z-2/recordings/" + take + ".srec"), "take") << "each start has its own";
  EXPECT_EQ(counts().files, 2U);
  EXPECT_EQ(counts().bytes, 8U);

  const auto back = start(DataFileKind::blob, {kept, lost});
  EXPECT_EQ(back.put_back, 1U);
  EXPECT_EQ(back.moved, 0U);
  EXPECT_EQ(start(DataFileKind::recording, {take}).put_back, 1U);
  EXPECT_EQ(read(data_file_path(DataFileKind::blob, lost)), "lost");
  EXPECT_EQ(read(data_file_path(DataFileKind::recording, take)), "take");
  EXPECT_EQ(counts().files, 0U);
  EXPECT_EQ(purge(noon).files, 0U);
  EXPECT_FALSE(fs::exists(data_ / "trash")) << "no empty folders stay";
}

TEST_F(TrashTest, Missing_IsNamed) {
  const auto there = blob("there");
  const auto nowhere = sha256_hex("nowhere");
  const auto result = start(DataFileKind::blob, {there, nowhere});
  EXPECT_EQ(result.missing, std::vector<std::string>{nowhere});
  EXPECT_EQ(start(DataFileKind::recording, {"../../passwd"}).missing, std::vector<std::string>{"../../passwd"});
}

TEST_F(TrashTest, Purge_TakesWhatHasBeenThereForTheGrace) {
  const auto old = blob("old");
  start(DataFileKind::blob, {}, noon);
  const auto young = blob("young one");
  start(DataFileKind::blob, {}, noon + hours(10));
  EXPECT_EQ(purge(noon + hours(24) - seconds(1)).files, 0U);
  EXPECT_EQ(purge(noon - hours(1000)).files, 0U) << "a clock that was set back";
  const auto removed = purge(noon + hours(24));
  EXPECT_EQ(removed.files, 1U);
  EXPECT_EQ(removed.bytes, 3U);
  EXPECT_EQ(counts().bytes, 9U);
  EXPECT_EQ(start(DataFileKind::blob, {old, young}).missing, std::vector<std::string>{old});
  EXPECT_TRUE(has(DataFileKind::blob, young));
}

TEST_F(TrashTest, NoGrace_IsUntilTheNextStart) {
  blob("text");
  Trash first(data_, seconds(0), noon);
  EXPECT_EQ(reconcile(data_, first, DataFileKind::blob, {}).moved, 1U);
  EXPECT_EQ(first.purge(noon + hours(1), {}).files, 0U) << "not by the start that moved it";
  EXPECT_EQ(first.counts().files, 1U);
  Trash second(data_, seconds(0), noon + seconds(1));
  EXPECT_EQ(second.purge(noon + seconds(1), {}).files, 1U);
  EXPECT_EQ(second.counts().files, 0U);
}

TEST_F(TrashTest, WhatNoServerPutThere_IsLeftAlone_AndLinksAreNotFollowed) {
  const auto elsewhere = data_ / "elsewhere";
  const auto hash = sha256_hex("mine");
  const auto prefix = hash.substr(0, 2);
  write("elsewhere/" + hash, "mine");
  write("elsewhere/aaaaaaaaaaaa.srec", "mine");
  write("blobs/notes.txt", "x");
  write("blobs/" + prefix + "/notes.txt", "x");
  write("blobs/zz/" + hash, "in the wrong folder");
  write("recordings/talk.srec", "not an id");
  write("recordings/aaaaaaaaaaab.srec.bak", "x");
  fs::create_directories(data_ / "recordings/aaaaaaaaaaac.srec");
  fs::create_directory_symlink(elsewhere, data_ / "blobs/linked");
  fs::create_directory_symlink(elsewhere, data_ / ("blobs/" + std::string(prefix == "aa" ? "bb" : "aa")));
  fs::create_symlink(elsewhere / hash, data_ / "blobs" / prefix / hash);
  fs::create_symlink(elsewhere / "aaaaaaaaaaaa.srec", data_ / "recordings/aaaaaaaaaaaa.srec");
  EXPECT_EQ(start(DataFileKind::blob, {}).moved, 0U);
  EXPECT_EQ(start(DataFileKind::recording, {}).moved, 0U);
  EXPECT_FALSE(fs::exists(data_ / "trash"));
  EXPECT_EQ(start(DataFileKind::blob, {hash}).missing.size(), 1U) << "a link is no blob";

  write("trash/notes.txt", "x");
  write("trash/2020-01-01T00-00-00Z-old/blobs/" + prefix + "/" + hash, "no server names a batch so");
  write("trash/2020-01-01T00-00-00Z/blobs/" + prefix + "/notes.txt", "x");
  fs::create_directory_symlink(elsewhere, data_ / "trash/2019-01-01T00-00-00Z");
  fs::create_directories(data_ / "trash/2018-01-01T00-00-00Z");
  fs::create_directory_symlink(elsewhere, data_ / "trash/2018-01-01T00-00-00Z/recordings");
  EXPECT_EQ(counts().files, 0U);
  EXPECT_EQ(purge(noon).files, 0U);
  EXPECT_EQ(start(DataFileKind::recording, {"aaaaaaaaaaaa"}).put_back, 0U);
  for (const auto& path : {"elsewhere/" + hash, std::string("elsewhere/aaaaaaaaaaaa.srec"),
                           std::string("trash/notes.txt"), "trash/2020-01-01T00-00-00Z/blobs/" + prefix + "/notes.txt"})
    EXPECT_TRUE(fs::exists(data_ / path)) << path;
}

TEST_F(TrashTest, LinkedTrash_TakesNothing_AndTheFileStays) {
  const auto hash = blob("text");
  fs::create_directories(data_ / "elsewhere");
  fs::create_directory_symlink(data_ / "elsewhere", data_ / "trash");
  const auto result = start(DataFileKind::blob, {});
  EXPECT_EQ(result.moved, 0U);
  EXPECT_EQ(result.failed, 1U);
  EXPECT_NE(result.fault, "");
  EXPECT_TRUE(has(DataFileKind::blob, hash));
}

TEST_F(TrashTest, FileInPlace_IsNotReplacedFromTheTrash) {
  const auto id = recording("older");
  start(DataFileKind::recording, {});
  write(data_file_path(DataFileKind::recording, id), "newer");
  EXPECT_EQ(start(DataFileKind::recording, {id}).put_back, 0U);
  EXPECT_EQ(read(data_file_path(DataFileKind::recording, id)), "newer");
  EXPECT_EQ(counts().files, 1U);
}

TEST_F(TrashTest, PurgedPeriodically_LosesWhatAppearsLaterToo) {
  blob("text");
  start(DataFileKind::blob, {}, noon);
  Trash trash(data_, seconds(1), noon);
  std::atomic<std::uint64_t> removed{0};
  const log::Periodic purger(
      "purging", std::chrono::milliseconds(5),
      [&](const std::stop_token& stop) { removed += trash.purge(std::chrono::system_clock::now(), stop).files; },
      log::Periodic::First::at_once);
  for (int i = 0; i < 2000 && removed < 1; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(removed, 1U);
  // The same thread, not another start: what appears later goes with a later round.
  write("trash/2024-10-04T12-00-01Z/" + data_file_path(DataFileKind::blob, sha256_hex("later")).string(), "later");
  for (int i = 0; i < 2000 && removed < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(removed, 2U);
}

TEST_F(TrashTest, KilledAtAnyMoment_LosesNothing) {
  std::map<std::string, std::string> texts;
  Names known;
  for (int i = 0; i < 400; ++i) {
    const auto text = "blob " + std::to_string(i);
    texts[blob(text)] = text;
    known.insert(sha256_hex(text));
  }
  // Children move everything into the trash and back until they are killed; purges have nothing to take.
  std::mt19937 random(1);
  for (int round = 0; round < 40; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      for (int turn = round;; ++turn) {
        Trash trash(data_, hours(24), noon);
        reconcile(data_, trash, DataFileKind::blob, turn % 2 == 0 ? Names() : known);
        trash.purge(noon + hours(1), {});
      }
    }
    ::usleep(random() % 30'000);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    std::size_t found = list_data_files(data_, DataFileKind::blob)->size();
    if (fs::exists(data_ / "trash"))
      for (const auto& batch : fs::directory_iterator(data_ / "trash"))
        found += list_data_files(batch.path(), DataFileKind::blob)->size();
    ASSERT_EQ(found, texts.size()) << "each is in one place";
  }
  const auto last = start(DataFileKind::blob, known);
  EXPECT_TRUE(last.missing.empty());
  EXPECT_EQ(counts().files, 0U);
  for (const auto& [hash, text] : texts) EXPECT_EQ(read(data_file_path(DataFileKind::blob, hash)), text);
}

TEST_F(TrashTest, KilledPurge_TakesOnlyWhatIsOver_AndGoesOn) {
  for (int i = 0; i < 400; ++i) blob("over " + std::to_string(i));
  start(DataFileKind::blob, {}, noon);
  Names young;
  for (int i = 0; i < 50; ++i) young.insert(blob("young " + std::to_string(i)));
  start(DataFileKind::blob, {}, noon + hours(20));
  std::mt19937 random(2);
  for (int round = 0; round < 10; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      purge(noon + hours(30));
      ::_exit(0);
    }
    ::usleep(random() % 3000);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ASSERT_GE(counts().files, young.size());
  }
  purge(noon + hours(30));
  EXPECT_EQ(counts().files, young.size());
  EXPECT_EQ(start(DataFileKind::blob, young).put_back, young.size());
}

TEST_F(TrashTest, LastDatabase_IsReadBack_AndRubbishIsNone) {
  EXPECT_FALSE(read_last_database(data_));
  const DatabaseIdentity identity{"0123abcd", 17};
  EXPECT_TRUE(write_last_database(data_, {"other", 1}));
  EXPECT_TRUE(write_last_database(data_, identity));
  EXPECT_EQ(read_last_database(data_), identity);
  for (const std::string text : {"", "x", " 1\n", "a b\n", "a 1", "a 1 2\n", "a -1\n", "a 99999999999999999999\n"}) {
    write("last-database", text);
    EXPECT_FALSE(read_last_database(data_)) << text;
  }
  fs::remove(data_ / "last-database");
  write("elsewhere", "a 1\n");
  fs::create_symlink(data_ / "elsewhere", data_ / "last-database");
  EXPECT_FALSE(read_last_database(data_)) << "a link is not followed";
  EXPECT_TRUE(write_last_database(data_, identity));
  EXPECT_EQ(read_last_database(data_), identity);
  EXPECT_EQ(read("elsewhere"), "a 1\n");
}

}  // namespace
}  // namespace semblante::store

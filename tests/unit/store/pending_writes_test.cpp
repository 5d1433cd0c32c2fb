// What cannot be written is kept, retried in order, said, and forgotten only when its owner goes.
#include "server/store/pending_writes.h"

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <future>

#include <gtest/gtest.h>

#include "tests/support/wait.h"

namespace semblante::store {
namespace {

using std::chrono::milliseconds;

/// A store that takes writes or not, and notes those it took.
class Disk {
 public:
  PendingWrites::Write write(std::string name) {
    return [this, name] {
      const std::lock_guard lock(mutex_);
      ++tried_;
      changed_.notify_all();
      if (full_) throw DiskFull("full");
      taken_.push_back(name);
    };
  }
  void set_full(bool full) {
    const std::lock_guard lock(mutex_);
    full_ = full;
  }
  bool wait_until_tried(std::size_t times) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, testing::patience, [&] { return tried_ >= times; });
  }
  bool wait_until_taken(std::size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, testing::patience, [&] { return taken_.size() >= count; });
  }
  std::vector<std::string> taken() {
    const std::lock_guard lock(mutex_);
    return taken_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool full_ = false;
  std::size_t tried_ = 0;
  std::vector<std::string> taken_;
};

PendingWrites::Options fast() {
  PendingWrites::Options options;
  options.first_delay = milliseconds(1);
  options.longest_delay = milliseconds(4);
  return options;
}

bool wait_until_writable(const PendingWrites& pending) {
  return testing::eventually([&] { return pending.status().writable; });
}

TEST(PendingWrites, WithRoom_WritesAtOnce) {
  Disk disk;
  PendingWrites pending(fast());
  EXPECT_TRUE(pending.write(this, "job", "the end of job", disk.write("a")));
  EXPECT_EQ(disk.taken(), std::vector<std::string>{"a"});
  EXPECT_TRUE(pending.status().writable);
  EXPECT_EQ(pending.status().count, 0U);
}

TEST(PendingWrites, WithoutRoom_KeepsAndRetriesInOrder) {
  Disk disk;
  PendingWrites pending(fast());
  disk.set_full(true);
  EXPECT_FALSE(pending.write(this, "job", "the start of job", disk.write("first")));
  EXPECT_FALSE(pending.write(this, "job", "the end of job", disk.write("second")));
  EXPECT_FALSE(pending.write(this, "recording", "the end of recording", disk.write("other")));
  EXPECT_TRUE(disk.wait_until_tried(10)) << "it goes on trying";
  const auto status = pending.status();
  EXPECT_FALSE(status.writable);
  EXPECT_TRUE(status.disk_full);
  EXPECT_EQ(status.count, 3U);
  EXPECT_EQ(status.what, (std::vector<std::string>{"the start of job", "the end of job", "the end of recording"}));
  disk.set_full(false);
  ASSERT_TRUE(disk.wait_until_taken(3));
  const auto taken = disk.taken();
  EXPECT_LT(std::find(taken.begin(), taken.end(), "first"), std::find(taken.begin(), taken.end(), "second"));
  EXPECT_TRUE(wait_until_writable(pending));
  EXPECT_EQ(pending.status().count, 0U);
}

TEST(PendingWrites, LaterWriteOfAResource_WaitsForTheEarlier_EvenWithRoom) {
  Disk disk;
  PendingWrites pending(fast());
  std::promise<void> go;
  auto began = std::make_shared<std::promise<void>>();
  auto first = std::async(std::launch::async, [&] {
    return pending.write(this, "job", "first", [&, began] {
      began->set_value();
      go.get_future().wait();
      disk.write("first")();
    });
  });
  began->get_future().wait();
  EXPECT_FALSE(pending.write(this, "job", "second", disk.write("second")));
  EXPECT_TRUE(pending.write(this, "other", "other", disk.write("other"))) << "other resources do not wait";
  go.set_value();
  EXPECT_TRUE(first.get());
  ASSERT_TRUE(disk.wait_until_taken(3));
  EXPECT_EQ(disk.taken(), (std::vector<std::string>{"other", "first", "second"}));
}

TEST(PendingWrites, OtherFault_IsKeptToo_AndSaidAsAnother) {
  std::atomic<bool> broken = true;
  std::promise<void> done;
  PendingWrites pending(fast());
  EXPECT_FALSE(pending.write(this, "job", "the end of job", [&] {
    if (broken) throw std::runtime_error("constraint failed");
    done.set_value();
  }));
  EXPECT_FALSE(pending.status().writable);
  EXPECT_FALSE(pending.status().disk_full);
  broken = false;
  EXPECT_EQ(done.get_future().wait_for(testing::patience), std::future_status::ready);
}

TEST(PendingWrites, Note_StaysUntilAProbeSucceeds) {
  Disk disk;
  auto options = fast();
  options.probe = disk.write("probe");
  disk.set_full(true);
  PendingWrites pending(options);
  pending.note(DiskFull("a request failed"));
  ASSERT_TRUE(disk.wait_until_tried(3));
  EXPECT_FALSE(pending.status().writable);
  EXPECT_EQ(pending.status().count, 0U);
  disk.set_full(false);
  EXPECT_TRUE(wait_until_writable(pending));
}

TEST(PendingWrites, Release_TriesOnceMore_AndForgetsTheRest) {
  Disk disk;
  const int mine = 0, theirs = 0;
  PendingWrites::Options options;
  options.first_delay = options.longest_delay = std::chrono::hours(1);  // nothing but release() tries again
  PendingWrites pending(options);
  disk.set_full(true);
  pending.write(&mine, "a", "a", disk.write("a"));
  pending.write(&theirs, "b", "b", disk.write("b"));
  pending.release(&mine);
  EXPECT_EQ(pending.status().what, std::vector<std::string>{"b"});
  disk.set_full(false);
  pending.release(&theirs);
  EXPECT_EQ(disk.taken(), std::vector<std::string>{"b"});
}

class ReserveTest : public ::testing::Test {
 protected:
  ReserveTest() {
    std::string name = (std::filesystem::temp_directory_path() / "semblante-reserve-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~ReserveTest() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(ReserveTest, IsFreedOnce_AndFilledAgain) {
  DiskReserve reserve(folder_ / "reserve", 1U << 16U);
  EXPECT_FALSE(reserve.release()) << "nothing is there yet";
  reserve.fill();
  EXPECT_EQ(std::filesystem::file_size(folder_ / "reserve"), 1U << 16U);
  EXPECT_TRUE(reserve.release());
  EXPECT_EQ(std::filesystem::file_size(folder_ / "reserve"), 0U);
  EXPECT_FALSE(reserve.release());
  reserve.fill();
  EXPECT_TRUE(DiskReserve(folder_ / "reserve", 1U << 16U).release()) << "a restart finds it";
}

TEST_F(ReserveTest, MakesRoomForAChange_AndIsBackBeforeTheDiskCountsAsWritable) {
  DiskReserve reserve(folder_ / "reserve", 1U << 16U);
  reserve.fill();
  auto options = fast();
  options.reserve = &reserve;
  std::atomic<bool> has_room = false;
  options.probe = [&] {
    if (!has_room) throw DiskFull("full");
  };
  PendingWrites pending(options);
  const auto needs_reserve = [&] {
    if (std::filesystem::file_size(folder_ / "reserve") != 0) throw DiskFull("full");
    return 7;
  };
  EXPECT_EQ(pending.with_reserve(needs_reserve), 7);
  EXPECT_FALSE(pending.status().writable);
  has_room = true;
  EXPECT_TRUE(wait_until_writable(pending));
  EXPECT_EQ(std::filesystem::file_size(folder_ / "reserve"), 1U << 16U);
  EXPECT_TRUE(pending.write(this, "job", "the end of job", [&] { needs_reserve(); }));
  EXPECT_TRUE(wait_until_writable(pending));
  EXPECT_THROW(pending.with_reserve([] { throw NotEnoughRoom("a job needs more"); }), NotEnoughRoom);
  EXPECT_NE(std::filesystem::file_size(folder_ / "reserve"), 0U) << "it is not for jobs";
}

}  // namespace
}  // namespace semblante::store

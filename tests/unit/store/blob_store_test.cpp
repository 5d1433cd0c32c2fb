#include "server/store/blob_store.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "protocol/hash/sha256.h"

namespace semblante::store {
namespace {

class BlobStoreTest : public ::testing::Test {
 protected:
  BlobStoreTest() {
    std::string name = (std::filesystem::temp_directory_path() / "semblante-blobs-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::ofstream(folder_ / "facts.sqlite") << "a file beside the blobs";
  }
  ~BlobStoreTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(BlobStoreTest, Blobs_AreNamedByTheirContent) {
  auto blobs = BlobStore::open(folder_);
  const auto blob = blobs.put("abc");
  ASSERT_TRUE(blob);
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(blob->sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(blob->bytes, 3U);
  EXPECT_TRUE(blobs.find(blob->sha256));
  EXPECT_EQ(blobs.put("abc")->sha256, blob->sha256);
  for (const auto& name : {std::string(), std::string("../facts.sqlite"), std::string("BA78"), std::string(64, '/')})
    EXPECT_FALSE(blobs.find(name));
  EXPECT_FALSE(blobs.adopt(folder_ / "absent"));
  const auto other = blobs.put("other");
  blobs.remove(blob->sha256);
  EXPECT_FALSE(blobs.find(blob->sha256));
  EXPECT_TRUE(blobs.find(other->sha256));
}

TEST_F(BlobStoreTest, LinkInThePlaceOfABlob_IsNone_AndIsReplaced) {
  auto blobs = BlobStore::open(folder_);
  const auto hash = sha256_hex("abc");
  std::filesystem::create_directories(folder_ / "blobs" / hash.substr(0, 2));
  const auto link = folder_ / "blobs" / hash.substr(0, 2) / hash;
  std::filesystem::create_symlink(folder_ / "facts.sqlite", link);
  EXPECT_FALSE(blobs.find(hash));
  ASSERT_TRUE(blobs.put("abc"));
  EXPECT_EQ(blobs.find(hash), link);
  EXPECT_EQ(std::filesystem::file_size(link), 3U);
}

/// Each way in which a file can change, on a blob of the bytes "abc".
struct Damage {
  const char* name;
  void (*apply)(const std::filesystem::path& file);
};

void write_back_in_time(const std::filesystem::path& file) {
  const auto written = std::filesystem::last_write_time(file);
  std::ofstream(file) << "abd";
  std::filesystem::last_write_time(file, written);
}

constexpr Damage damages[] = {
    {"a changed byte, the time of the write set back", write_back_in_time},
    {"cut off", [](const std::filesystem::path& file) { std::filesystem::resize_file(file, 2); }},
    {"grown", [](const std::filesystem::path& file) { std::ofstream(file, std::ios::app) << "d"; }},
    {"empty", [](const std::filesystem::path& file) { std::filesystem::resize_file(file, 0); }},
    {"gone", [](const std::filesystem::path& file) { std::filesystem::remove(file); }},
    {"another file",
     [](const std::filesystem::path& file) {
       std::ofstream(file.string() + ".new") << "xyz";
       std::filesystem::rename(file.string() + ".new", file);
     }},
};

TEST_F(BlobStoreTest, DamagedBlob_IsNotWhole_AndIsMendedByTheSameBytes) {
  for (const auto& damage : damages) {
    for (const bool known : {false, true}) {
      SCOPED_TRACE(std::string(damage.name) + (known ? ", verified before" : ""));
      const auto hash = BlobStore::open(folder_).put("abc")->sha256;
      const auto blobs = BlobStore::open(folder_);  // another process
      const auto file = *blobs.find(hash);
      if (known) {
        EXPECT_EQ(blobs.whole(hash), file);
      }
      damage.apply(file);
      try {
        (void)blobs.whole(hash);
        ADD_FAILURE() << "it is given out";
      } catch (const DamagedBlob& fault) {
        EXPECT_NE(std::string(fault.what()).find(hash), std::string::npos);
        EXPECT_EQ(std::string(fault.what()).find(folder_.string()), std::string::npos);
      }
      ASSERT_TRUE(blobs.put("abc"));
      EXPECT_EQ(blobs.whole(hash), file);
      EXPECT_EQ(std::filesystem::file_size(file), 3U);
      EXPECT_EQ(BlobStore::open(folder_).whole(hash), file);
    }
  }
}

TEST_F(BlobStoreTest, BlobOfAnotherSize_IsDamaged_AndIsNotRead) {
  const auto blobs = BlobStore::open(folder_);
  const auto hash = blobs.put("abc")->sha256;
  const auto file = *blobs.find(hash);
  EXPECT_EQ(blobs.whole(hash, 3), file);
  EXPECT_THROW((void)blobs.whole(hash, 4), DamagedBlob);
  constexpr std::uintmax_t of_an_hour = std::uintmax_t{1} << 42U;  // to hash it
  std::filesystem::resize_file(file, of_an_hour);
  EXPECT_THROW((void)blobs.whole(hash, 3), DamagedBlob);
}

TEST_F(BlobStoreTest, IntactBlob_IsKeptWhenItComesAgain) {
  const auto blobs = BlobStore::open(folder_);
  const auto hash = blobs.put("abc")->sha256;
  const auto file = *blobs.find(hash);
  std::filesystem::create_hard_link(file, folder_ / "the-same-file");
  EXPECT_EQ(blobs.whole(hash), file);
  ASSERT_TRUE(blobs.put("abc"));
  EXPECT_TRUE(std::filesystem::equivalent(file, folder_ / "the-same-file"));
}

TEST_F(BlobStoreTest, WhateverIsNoHash_IsNotWhole) {
  const auto blobs = BlobStore::open(folder_);
  for (const auto& name : {std::string(), std::string("../facts.sqlite"), std::string(64, '/')})
    EXPECT_THROW((void)blobs.whole(name), DamagedBlob);
}

}  // namespace
}  // namespace semblante::store

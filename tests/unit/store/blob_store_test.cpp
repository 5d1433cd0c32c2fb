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
  ASSERT_TRUE(blobs);
  const auto blob = blobs->put("abc");
  ASSERT_TRUE(blob);
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(blob->sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(blob->bytes, 3U);
  EXPECT_TRUE(blobs->find(blob->sha256));
  EXPECT_EQ(blobs->put("abc")->sha256, blob->sha256);
  for (const auto& name : {std::string(), std::string("../facts.sqlite"), std::string("BA78"), std::string(64, '/')})
    EXPECT_FALSE(blobs->find(name));
  EXPECT_FALSE(blobs->adopt(folder_ / "absent"));
  const auto other = blobs->put("other");
  blobs->remove(blob->sha256);
  EXPECT_FALSE(blobs->find(blob->sha256));
  EXPECT_TRUE(blobs->find(other->sha256));
}

TEST_F(BlobStoreTest, LinkInThePlaceOfABlob_IsNone_AndIsReplaced) {
  auto blobs = BlobStore::open(folder_);
  const auto hash = sha256_hex("abc");
  std::filesystem::create_directories(folder_ / "blobs" / hash.substr(0, 2));
  const auto link = folder_ / "blobs" / hash.substr(0, 2) / hash;
  std::filesystem::create_symlink(folder_ / "facts.sqlite", link);
  EXPECT_FALSE(blobs->find(hash));
  ASSERT_TRUE(blobs->put("abc"));
  EXPECT_EQ(blobs->find(hash), link);
  EXPECT_EQ(std::filesystem::file_size(link), 3U);
}

}  // namespace
}  // namespace semblante::store

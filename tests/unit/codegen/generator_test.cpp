#include "core/codegen/generator.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semblante::codegen {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<GeneratedFile> two_files(const std::string&) { return {{"one.h", "1\n"}, {"two.ts", "2\n"}}; }
std::vector<GeneratedFile> faulty(const std::string&) { throw std::runtime_error("no data"); }

class GeneratorTest : public ::testing::Test {
 protected:
  GeneratorTest() {
    std::string pattern = ::testing::TempDir() + "semblante-codegen-XXXXXX";
    folder_ = mkdtemp(pattern.data());
  }
  ~GeneratorTest() override { std::filesystem::remove_all(folder_); }

  int run(Generator generate) {
    std::string name = "generator";
    std::vector<char*> arguments = {name.data(), folder_.data()};
    return run_generator(2, arguments.data(), generate);
  }

  std::string folder_;
};

TEST_F(GeneratorTest, WhatWasWritten_IsUpToDate_UntilItIsChanged) {
  ASSERT_EQ(run(two_files), 0);
  EXPECT_EQ(read_text(folder_ + "/one.h"), "1\n");
  EXPECT_THAT(out_of_date(folder_, two_files), IsEmpty());
  std::ofstream(folder_ + "/two.ts") << "by hand\n";
  EXPECT_THAT(out_of_date(folder_, two_files), ElementsAre("two.ts"));
}

TEST_F(GeneratorTest, OutputFolder_IsMadeAndTakesTheFiles) {
  std::string name = "generator", output = folder_ + "/build/generated";
  std::vector<char*> arguments = {name.data(), folder_.data(), output.data()};
  ASSERT_EQ(run_generator(3, arguments.data(), two_files), 0);
  EXPECT_EQ(read_text(output + "/one.h"), "1\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ + "/one.h"));
}

TEST_F(GeneratorTest, Faults_AreAnExitStatus) {
  EXPECT_EQ(run(faulty), 1);
  std::string name = "generator";
  std::vector<char*> arguments = {name.data()};
  EXPECT_EQ(run_generator(1, arguments.data(), two_files), 2);
}

TEST_F(GeneratorTest, ReadJson_NamesTheFile) {
  std::ofstream(folder_ + "/broken.json") << "{";
  for (const char* const name : {"/broken.json", "/absent.json"}) {
    try {
      read_json(folder_ + name);
      ADD_FAILURE() << name;
    } catch (const std::exception& fault) {
      EXPECT_THAT(fault.what(), ::testing::HasSubstr(folder_ + name));
    }
  }
}

}  // namespace
}  // namespace semblante::codegen

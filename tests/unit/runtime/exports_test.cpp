#include <array>
#include <cstdio>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "core/tables/mpeg4.h"

namespace semblante::testing {
namespace {

std::set<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    found.insert((*it)[1]);
  }
  return found;
}

std::string read(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// By hand: std::regex needs a stack as deep as a comment is long.
std::string without_comments(std::string text) {
  for (std::size_t begin = 0; (begin = text.find("/*", begin)) != std::string::npos;) {
    const std::size_t end = text.find("*/", begin);
    text.erase(begin, end == std::string::npos ? end : end + 2 - begin);
  }
  return text;
}

std::string output_of(const std::string& command) {
  std::string text;
  if (FILE* pipe = popen(command.c_str(), "r"); pipe != nullptr) {
    std::array<char, 4096> buffer{};
    while (const std::size_t size = fread(buffer.data(), 1, buffer.size(), pipe)) {
      text.append(buffer.data(), size);
    }
    pclose(pipe);
  }
  return text;
}

TEST(SdkExports, SharedLibrary_ShowsExactlyTheList) {
  const auto listed =
      matches(read(SEMBLANTE_SOURCE_DIR "/clients/runtime/exports.map"), std::regex(R"((semblante_\w+);)"));
  ASSERT_GT(listed.size(), 10U);
  const auto shown =
      matches(output_of("nm -D --defined-only '" SEMBLANTE_SDK_LIBRARY "'"), std::regex(R"( [A-Z] (\S+))"));
  EXPECT_EQ(shown, listed);
}

TEST(SdkExports, Header_DeclaresExactlyTheList) {
  const auto listed =
      matches(read(SEMBLANTE_SOURCE_DIR "/clients/runtime/exports.map"), std::regex(R"((semblante_\w+);)"));
  std::string headers = read(SEMBLANTE_SOURCE_DIR "/clients/runtime/semblante.h");
  headers += read(SEMBLANTE_SOURCE_DIR "/core/kernel/semblante_prepared_face.h");
  headers += read(SEMBLANTE_SOURCE_DIR "/core/kernel/semblante_normals.h");
  headers += read(SEMBLANTE_SOURCE_DIR "/core/kernel/semblante_ease.h");
  headers += read(SEMBLANTE_SOURCE_DIR "/core/kernel/semblante_kernel.h");
  headers = without_comments(headers);
  const std::string code = std::regex_replace(headers, std::regex(R"(#ifdef __wasm__[^#]*#endif)"), "");
  EXPECT_EQ(matches(code, std::regex(R"(\b(semblante_\w+)\()")), listed);
}

/// "0 none, 1 joy, ...": what a frame's number means.
template <class Entries>
std::string numbered(const Entries& entries) {
  std::string text;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    text += (i > 0 ? ", " : "") + std::to_string(i) + " " + std::string(entries[i].name);
  }
  return text + "\n";
}

TEST(SdkExports, Header_NamesTheVisemesAndExpressionsOfTheTables) {
  const std::string header = read(SEMBLANTE_SOURCE_DIR "/clients/runtime/semblante.h");
  EXPECT_NE(header.find("viseme: " + numbered(mpeg4::visemes)), std::string::npos);
  EXPECT_NE(header.find("expression: " + numbered(mpeg4::expressions)), std::string::npos);
}

}  // namespace
}  // namespace semblante::testing

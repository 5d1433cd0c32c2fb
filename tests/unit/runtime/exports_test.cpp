#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace semblante::testing {
namespace {

/// The shared library as it stands on 64-bit Linux; growth past this is to be noticed, not to happen.
constexpr std::uintmax_t max_library_bytes = 512U << 10U;

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
  const std::string kernel = read(SEMBLANTE_SOURCE_DIR "/core/kernel/semblante_kernel.h");
  headers += std::regex_replace(kernel, std::regex(R"(#ifdef __wasm__[^#]*#endif)"), "");
  const std::string code = std::regex_replace(headers, std::regex(R"(/\*(.|\n)*?\*/)"), "");
  EXPECT_EQ(matches(code, std::regex(R"(\b(semblante_\w+)\()")), listed);
}

TEST(SdkExports, SharedLibrary_StaysSmall) {
  EXPECT_LT(std::filesystem::file_size(SEMBLANTE_SDK_LIBRARY), max_library_bytes);
}

}  // namespace
}  // namespace semblante::testing

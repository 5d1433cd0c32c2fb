// README.md's "Your first head", run line by line as it is printed, against the real server.

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/integration/client/sample_server.h"

namespace semblante {
namespace {

std::string read_all(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The indented lines of one section.
std::string script_of(const std::string& section) {
  std::istringstream lines(read_all(SEMBLANTE_SOURCE_DIR "/README.md"));
  std::string script;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) inside = line == "## " + section;
    if (inside && line.starts_with("    ")) script += line.substr(4) + "\n";
  }
  return script;
}

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

TEST(Readme, FirstHead_IsAsPrinted) {
  const testing::SampleServer server;
  auto script = script_of("Your first head");
  ASSERT_NE(script.find("semblante-client"), std::string::npos);
  replace_all(script, "http://127.0.0.1:8080", server.url());
  replace_all(script, "build/bin/semblante-client", SEMBLANTE_CLIENT);
  const auto folder = server.folder() / "readme";
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(server.model_file(), folder / "head.glb");
  std::filesystem::copy_file(server.points_file(), folder / "head.fps.json");
  std::ofstream(folder / "script") << script;
  const auto command = "cd '" + folder.string() + "' && bash -e -o pipefail script > printed 2> complaints < /dev/null";
  const int status = std::system(command.c_str());  // NOLINT(cert-env33-c,concurrency-mt-unsafe): as a user types it
  const auto printed = read_all(folder / "printed");
  EXPECT_EQ(status, 0) << printed << read_all(folder / "complaints");
  EXPECT_EQ(printed.find("/problems/"), std::string::npos) << printed;
  EXPECT_NE(printed.find("event: done"), std::string::npos) << printed;
  EXPECT_NE(printed.find("\"accepted\":1"), std::string::npos) << printed;
  EXPECT_NE(printed.find("\"name\":\"speech\""), std::string::npos) << printed;
  for (const char* name : {"mesh.drc", "weights", "rig.json", "frames/frame-00002.png"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
}

}  // namespace
}  // namespace semblante

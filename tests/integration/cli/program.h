#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace semblante::test {

/// What a run of the program left behind.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs the built `semblante` with these arguments and, beside the test's own environment, these variables; with the
/// file `input` on its standard input, if there is one.
Outcome run_semblante(const std::vector<std::string>& arguments,
                      const std::vector<std::pair<std::string, std::string>>& environment = {},
                      const std::string& input = {});

/// An empty folder of its own for each test, removed at the end.
class Workspace {
 public:
  Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  ~Workspace();

  /// Writes a file and gives its path.
  [[nodiscard]] std::string write(const std::string& name, const std::string& content) const;
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

std::string read_text(const std::filesystem::path& path);
std::size_t line_count(const std::string& text);
/// Without its end of line.
std::string first_line(const std::string& text);

}  // namespace semblante::test

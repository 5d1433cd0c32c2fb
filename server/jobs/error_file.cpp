#include "server/jobs/error_file.h"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <unistd.h>

#include "server/store/store_error.h"

namespace semblante::jobs {

ErrorFile::ErrorFile(const std::filesystem::path& folder) {
  std::string name =
      ((folder.empty() ? std::filesystem::temp_directory_path() : folder) / "semblante-errors-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  if (file < 0) store::throw_store_error(name, errno);
  ::close(file);
  path_ = name;
}

ErrorFile::~ErrorFile() { ::unlink(path_.c_str()); }

}  // namespace semblante::jobs

#include "tests/support/full_disk.h"

#include <cstdlib>
#include <fstream>

namespace semblante::test {

FullDisk::FullDisk(const std::filesystem::path& folder)
    : flag_(folder.string() + ".full"), trigger_(folder.string() + ".trigger") {
  set('0');
  ::setenv("SEMBLANTE_FULL_DISK_FOLDER", folder.c_str(), 1);
  ::setenv("SEMBLANTE_FULL_DISK_FLAG", flag_.c_str(), 1);
  ::setenv("SEMBLANTE_FULL_DISK_TRIGGER", trigger_.c_str(), 1);
  ::setenv("LD_PRELOAD", SEMBLANTE_FULL_DISK_LIBRARY, 1);
}

FullDisk::~FullDisk() {
  std::error_code ignored;
  std::filesystem::remove(trigger_, ignored);
  std::filesystem::remove(flag_, ignored);
  for (const char* name :
       {"SEMBLANTE_FULL_DISK_FOLDER", "SEMBLANTE_FULL_DISK_FLAG", "SEMBLANTE_FULL_DISK_TRIGGER", "LD_PRELOAD"})
    ::unsetenv(name);
}

void FullDisk::fill() { set('1'); }

void FullDisk::free() {
  std::error_code ignored;
  std::filesystem::remove(trigger_, ignored);
  set('0');
}

void FullDisk::fill_after_removal(const std::string& part) {
  // Whole at once: the other side may look at any time.
  std::ofstream(trigger_.string() + ".new") << part;
  std::filesystem::rename(trigger_.string() + ".new", trigger_);
}

bool FullDisk::is_full() const { return std::ifstream(flag_).get() == '1'; }

void FullDisk::set(char value) const {
  // In its place: the processes of the test map the file.
  if (!std::filesystem::exists(flag_)) std::ofstream(flag_) << value;
  std::fstream(flag_, std::ios::in | std::ios::out) << value;
}

}  // namespace semblante::test

#pragma once

#include <filesystem>

namespace semblante::voice {

/// Maps the dictionaries of all languages, so that libespeak-ng can read them when this process can open files no
/// longer: it opens the dictionary of another language at the first word of it, and without it crashes (1.51). The
/// program's own fopen() and stat(), which the library calls in place of the C library's, answer for these files from
/// memory. To be called once, by one thread. A file that cannot be mapped is left out.
void keep_dictionaries(const std::filesystem::path& data);

}  // namespace semblante::voice

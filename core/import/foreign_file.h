#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/advice.h"

namespace semblante::import {

/// What people send in place of a model, as a sentence, and what helps.
struct ForeignFile {
  std::string sentence;
  Advice advice;
};

/// nullopt for bytes that may be a model, or of which nothing is known. Known are the usual formats of 3D programs
/// without a reader here, archives other than zip, pictures, web pages (a download that failed) and pointers of Git
/// LFS.
std::optional<ForeignFile> foreign_file(std::span<const std::uint8_t> bytes);

/// What a zip without a model has in its place, by the names of its entries; nullopt if none is known.
std::optional<ForeignFile> foreign_zip(const std::vector<std::string>& names);

}  // namespace semblante::import

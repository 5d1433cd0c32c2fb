#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace semblante::import {

/// What a file is that people send in place of a model, and what to do, as a sentence; nullopt for any other bytes.
/// Known are the usual formats of 3D programs without a reader here, archives other than zip, pictures, web pages (a
/// download that failed) and pointers of Git LFS.
std::optional<std::string> foreign_file(std::span<const std::uint8_t> bytes);

/// The same of a zip without a model, by the names of its entries.
std::optional<std::string> foreign_zip(const std::vector<std::string>& names);

}  // namespace semblante::import

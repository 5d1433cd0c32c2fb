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

/// What a zip without a model has in its place, and what to do, by the names of its entries; nullopt if none is known.
std::optional<std::string> foreign_zip(const std::vector<std::string>& names);

}  // namespace semblante::import

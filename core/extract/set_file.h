#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "core/extract/named_set.h"
#include "core/types/result.h"

namespace semblante {

/// {"name": "smile", "kind": "expression", "displacements": {"2.1": [x, y, z], ...}}, in FAPU units: a displacement set
/// for any head. `name` is optional (default empty; at most 200 bytes, printable), `kind` too (default expression);
/// unknown members are ignored. Points that do not move are dropped; a set may be empty. Errors have a JSON pointer
/// (unknown feature point, not three numbers, a number beyond most_set_units), or a byte offset for invalid
/// JSON.
Result<NamedSet> parse_displacement_set(std::string_view json);

/// Only the displacements, {"2.1": [x, y, z], ...}, with the checks of parse_displacement_set.
Result<std::vector<Displacement>> parse_set_displacements(std::string_view json);

/// The same of a parsed document.
Result<std::vector<Displacement>> displacements_from_json(const nlohmann::json& json);

/// The form that parse_set_displacements reads, by increasing point.
nlohmann::ordered_json displacements_to_json(const std::vector<Displacement>& displacements);

/// The complete file; parse_displacement_set reads the exact values back.
std::string write_displacement_set(const NamedSet& set);

}  // namespace semblante

#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "core/extract/named_set.h"
#include "core/types/result.h"

namespace semblante {

/// {"name": "smile", "kind": "expression", "displacements": {"2.1": [x, y, z], ...}}, in FAPU units: a displacement set
/// for any head. `name` may be absent (then empty; at most 200 bytes, printable), `kind` too (then an expression);
/// members we do not know are left alone. Points that do not move are dropped; a set may be empty. Errors carry a JSON
/// pointer: no such feature point, no three numbers, a number beyond most_set_units, or a byte where it is no JSON at
/// all.
Result<NamedSet> parse_displacement_set(std::string_view json);

/// The displacements alone, {"2.1": [x, y, z], ...}, with the checks of parse_displacement_set.
Result<std::vector<Displacement>> parse_set_displacements(std::string_view json);

/// The same of a document that has been read.
Result<std::vector<Displacement>> displacements_from_json(const nlohmann::json& json);

/// What parse_set_displacements reads; points rising.
nlohmann::ordered_json displacements_to_json(const std::vector<Displacement>& displacements);

/// The whole, as parse_displacement_set reads it back to the bit.
std::string write_displacement_set(const NamedSet& set);

}  // namespace semblante

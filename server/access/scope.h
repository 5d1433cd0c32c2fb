#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace semblante::access {

/// What a request needs, and what a token allows. A scope includes those before it.
enum class Scope : std::uint8_t {
  none,     ///< anyone may: health, version, documents, the studio's pages
  read,     ///< look at and fetch everything, subscribe to streams
  publish,  ///< feed streams: frames, performances, .fap files
  edit,     ///< create, change and remove models, points, expressions, streams, recordings, speeches
  admin,    ///< create and revoke tokens, read metrics
};

/// In the order of Scope; in tokens, in openapi.json, on command lines.
inline constexpr std::array<std::string_view, 5> scope_names = {"none", "read", "publish", "edit", "admin"};
/// "read, publish, edit or admin": those of a token, for people.
std::string token_scopes_in_words();

constexpr std::string_view scope_name(Scope scope) { return scope_names[static_cast<std::size_t>(scope)]; }
/// The scope of a token; nullopt for other words, "none" among them.
std::optional<Scope> parse_scope(std::string_view name);

}  // namespace semblante::access

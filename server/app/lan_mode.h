#pragma once

#include <cstdint>
#include <filesystem>

#include "server/app/listening.h"
#include "server/store/token_store.h"

namespace semblante {

/// What `serve --lan` listens with: a certificate of its own and all addresses, for phones in the same network. Throws
/// CommandFailure.
ListenOptions listening_at_home(ListenOptions options, const std::filesystem::path& data);

/// A token for this run of `serve --lan`; those of earlier runs end. Prints how a phone gets in.
void invite(store::TokenStore& tokens, std::uint16_t port);

}  // namespace semblante

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "clients/runtime/semblante.h"
#include "core/types/result.h"

namespace semblante::client {

/// What the answer to a refused WebSocket says about the stream at `where`; empty if it says nothing about it.
inline std::optional<Error> stream_refusal(int status, std::string_view body, const std::string& where) {
  if (status == 404) {
    // Any server answers 404 to an address that it does not know, and so does a proxy whose server is away; a problem
    // document is of a Semblante server.
    if (body.find("/problems/not-found") != std::string_view::npos)
      return Error{ErrorCode::missing, where, "there is no such stream"};
    return Error{ErrorCode::io, where, "the server answered 404, as no Semblante server does: is this its address?"};
  }
  if (status == 401 || status == 403)
    return Error{ErrorCode::invalid_argument, where, "the server does not accept the token, or asks for one"};
  return std::nullopt;
}

inline Error no_such_subprotocol(std::string_view protocol, const std::string& where) {
  return {ErrorCode::mismatch, where, "the server does not support the subprotocol " + std::string(protocol)};
}

/// Why the server ends a connection: `code` of SEMBLANTE_EVENT_END.
inline Error end_of_stream(std::uint32_t code, const std::string& where) {
  switch (code) {
    case SEMBLANTE_END_FINISHED:
      return {ErrorCode::io, where, "the stream has ended"};
    case SEMBLANTE_END_DELETED:
      return {ErrorCode::io, where, "the stream was deleted"};
    case SEMBLANTE_END_SHUTDOWN:
      return {ErrorCode::io, where, "the server shuts down"};
    case SEMBLANTE_END_REPLACED:
      return {ErrorCode::io, where, "another source took over"};
    case SEMBLANTE_END_SLOW:
      return {ErrorCode::io, where, "this client reads too slowly"};
    default:
      return {ErrorCode::io, where, "the server ended the connection"};
  }
}

}  // namespace semblante::client

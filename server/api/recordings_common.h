#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "server/api/common.h"
#include "server/recordings/recording_reader.h"

namespace semblante::api {

/// The recording in the request's path; refuses with 404.
recordings::RecordingStatus recording_of(Context& context, const http::Request& request);

/// The durable part of the recording's file. Refuses with 409 a file that cannot be read.
std::shared_ptr<const recordings::ByteSource> bytes_of(Context& context, const recordings::RecordingStatus& recording);
std::shared_ptr<const recordings::RecordingReader> read_recording(Context& context,
                                                                  const recordings::RecordingStatus& recording);
[[noreturn]] void refuse_damaged(const Error& error);

/// The whole number of the query parameter `name`, 0..most; `otherwise` without the parameter.
std::uint32_t whole_number(const http::Request& request, const std::string& name, std::uint32_t otherwise,
                           std::uint32_t most);

answer::Recording represent(const recordings::RecordingStatus& recording);

}  // namespace semblante::api

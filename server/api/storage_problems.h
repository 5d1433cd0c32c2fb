#pragma once

#include <string>

#include "core/types/result.h"
#include "server/api/api.h"
#include "server/http/problem.h"
#include "server/store/blob_store.h"
#include "server/store/store_error.h"

namespace semblante::api {

/// The problem document for a store that cannot be read or written: 507 `insufficient-storage` or 503
/// `storage-unavailable`.
http::Problem problem_of(const store::StoreError& error);

/// 500 `damaged-data`: names the blob.
http::Problem problem_of(const store::DamagedBlob& error);

/// Throws StoreError for a file that cannot be stored; Api::handle turns it into the answer.
[[noreturn]] void refuse_unkept(const Error& error);

/// Refuses a request that has taken effect but is not durable yet; `effect` is a sentence: "the job is cancelled".
[[noreturn]] void refuse_pending(const Context& context, const std::string& effect);

/// "2 changes wait to be recorded: the end of job a, the end of recording b"; empty for none.
std::string pending_in_words(const store::PendingStatus& status);

}  // namespace semblante::api

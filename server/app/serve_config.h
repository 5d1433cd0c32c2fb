#pragma once

#include "server/api/api.h"
#include "server/app/listening.h"
#include "server/app/open_files.h"
#include "server/app/serve.h"
#include "server/jobs/job_queue.h"
#include "server/net/server.h"
#include "server/recordings/recorder.h"
#include "server/store/blob_store.h"

namespace semblante {

// What each part of the server is configured with, from the options of `serve`.

jobs::JobConfig job_config(const ServeOptions& options, const jobs::Isolation& isolation);
recordings::RecorderLimits recorder_limits(const ServeOptions& options);
/// All but `network_urls`, which only a server that listens knows.
api::ApiConfig api_config(const ServeOptions& options, const Listening& listening, const store::BlobStore& blobs);
net::ServerConfig net_config(const ServeOptions& options, const Listening& listening, const store::BlobStore& blobs,
                             const OpenFiles& open_files);

}  // namespace semblante

#pragma once

#include "server/store/artefact_store.h"
#include "server/store/database_facts.h"
#include "server/store/job_store.h"
#include "server/store/key_store.h"
#include "server/store/model_store.h"
#include "server/store/owner_store.h"
#include "server/store/recording_store.h"
#include "server/store/set_store.h"
#include "server/store/speech_store.h"
#include "server/store/store_error.h"
#include "server/store/stream_store.h"
#include "server/store/token_store.h"

namespace semblante::store {

/// Facts about models, jobs and streams. Every call that changes something returns after the change is durable: it
/// survives a crash of the process and of the machine. Calls may come from any thread but never from an I/O thread:
/// they wait for the disk. A full disk throws DiskFull, a failing one another StoreError: nothing was changed. Code
/// that needs only one part depends on that part's interface. A part may have another implementation, as long as calls
/// that change two parts stay one transaction.
class Store : public virtual ModelStore,
              public virtual ArtefactStore,
              public virtual JobStore,
              public virtual SetStore,
              public virtual StreamStore,
              public virtual RecordingStore,
              public virtual SpeechStore,
              public virtual KeyStore,
              public virtual TokenStore,
              public virtual OwnerStore,
              public virtual DatabaseFacts {};

}  // namespace semblante::store

#include "server/store/sqlite_owner_store.h"

#include <mutex>

namespace semblante::store {

Usage SqliteOwnerStore::usage_of(std::string_view owner) {
  const std::lock_guard lock(mutex_);
  Statement row(db_,
                "SELECT "
                "CAST((SELECT total(bytes) FROM (SELECT a.sha256, max(a.bytes) AS bytes FROM models m "
                "  JOIN artefacts a ON a.model = m.id WHERE m.owner = ?1 GROUP BY a.sha256)) "
                "+ (SELECT total(bytes) FROM recordings WHERE owner = ?1) "
                "+ (SELECT total(f.bytes) FROM speeches s JOIN speech_files f ON f.speech = s.id "
                "   WHERE s.owner = ?1) "
                "+ (SELECT total(length(CAST(displacements AS BLOB))) FROM displacement_sets "
                "   WHERE owner = ?1) AS INTEGER), "
                "(SELECT count(*) FROM models WHERE owner = ?1), "
                "(SELECT count(*) FROM displacement_sets WHERE owner = ?1) "
                "+ (SELECT count(*) FROM jobs WHERE owner = ?1 AND state IN (0, 1) AND kind = 'extract'), "
                "(SELECT count(*) FROM streams WHERE owner = ?1), "
                "(SELECT count(*) FROM recordings WHERE owner = ?1), "
                "(SELECT count(*) FROM speeches WHERE owner = ?1), "
                "(SELECT count(*) FROM jobs WHERE owner = ?1 AND state IN (0, 1))");
  row.bind(owner);
  row.step();
  return {row.whole(0), row.whole(1), row.whole(2), row.whole(3), row.whole(4), row.whole(5), row.whole(6)};
}

}  // namespace semblante::store

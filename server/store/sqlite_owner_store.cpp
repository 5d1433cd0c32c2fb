#include "server/store/sqlite_owner_store.h"

#include <mutex>

namespace semblante::store {

Usage SqliteOwnerStore::usage_of(std::string_view owner) {
  const std::lock_guard lock(mutex_);
  Statement row(db_,
                "SELECT "
                "(SELECT coalesce(sum(bytes), 0) FROM (SELECT a.sha256, max(a.bytes) AS bytes FROM models m "
                "  JOIN artefacts a ON a.model = m.id WHERE m.owner = ?1 GROUP BY a.sha256)) "
                "+ (SELECT coalesce(sum(bytes), 0) FROM recordings WHERE owner = ?1) "
                "+ (SELECT coalesce(sum(f.bytes), 0) FROM speeches s JOIN speech_files f ON f.speech = s.id "
                "   WHERE s.owner = ?1) "
                "+ (SELECT coalesce(sum(length(CAST(displacements AS BLOB))), 0) FROM displacement_sets "
                "   WHERE owner = ?1), "
                "(SELECT count(*) FROM models WHERE owner = ?1), "
                "(SELECT count(*) FROM displacement_sets WHERE owner = ?1) "
                "+ (SELECT count(*) FROM jobs WHERE owner = ?1 AND state IN (0, 1) AND kind = 'extract'), "
                "(SELECT count(*) FROM streams WHERE owner = ?1), "
                "(SELECT count(*) FROM recordings WHERE owner = ?1), "
                "(SELECT count(*) FROM speeches WHERE owner = ?1), "
                "(SELECT count(*) FROM jobs WHERE owner = ?1 AND state IN (0, 1))");
  row.bind(owner);
  row.step();
  const auto number = [&row](int column) { return static_cast<std::uint64_t>(row.integer(column)); };
  return {number(0), number(1), number(2), number(3), number(4), number(5), number(6)};
}

}  // namespace semblante::store

-- What every version of the service needs to know about its own database.

CREATE TABLE schema_migrations (
  number     INTEGER PRIMARY KEY,
  name       TEXT NOT NULL,
  checksum   BLOB NOT NULL CHECK (length(checksum) = 32),  -- SHA-256 of the migration's text
  applied_at INTEGER NOT NULL                              -- ns since 1970, UTC
) STRICT;

-- Written to find out whether commits work again after one has failed.
CREATE TABLE storage_probe (
  id        INTEGER PRIMARY KEY CHECK (id = 1),
  probed_at INTEGER NOT NULL
) STRICT;
INSERT INTO storage_probe VALUES (1, 0);

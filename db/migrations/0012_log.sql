-- The log of this data folder: what makes it one of many, and the tree over its measurements.

CREATE TABLE log (
  id      INTEGER PRIMARY KEY CHECK (id = 1),
  origin  BLOB NOT NULL CHECK (length(origin) = 16),  -- random: no other folder has it
  name    TEXT,                                       -- in its checkpoints, from the first start on
  chained INTEGER NOT NULL,  -- up to this id a row's hash is that of the old chain, then that of its leaf
  size    INTEGER NOT NULL DEFAULT 0,  -- rows that are in the tree
  seal    BLOB CHECK (length(seal) = 32)
) STRICT;
INSERT INTO log (id, origin, chained) SELECT 1, randomblob(16), coalesce(max(id), 0) FROM measurements;

-- The public keys that have signed checkpoints.
CREATE TABLE log_keys (
  number     INTEGER PRIMARY KEY,
  vkey       TEXT NOT NULL UNIQUE,
  created_at INTEGER NOT NULL,
  seal       BLOB CHECK (length(seal) = 32)
) STRICT;

-- Roots of 256^level leaves, made after the commit from the measurements' hashes alone.
CREATE TABLE log_nodes (
  level INTEGER NOT NULL CHECK (level BETWEEN 1 AND 7),
  node  INTEGER NOT NULL,
  hash  BLOB NOT NULL CHECK (length(hash) = 32),
  PRIMARY KEY (level, node)
) STRICT, WITHOUT ROWID;

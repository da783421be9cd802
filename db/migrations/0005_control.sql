-- The control's disk with its revisions, machine setups, runs.

CREATE TABLE file_revisions (
  revision    INTEGER PRIMARY KEY AUTOINCREMENT,
  path        TEXT NOT NULL CHECK (path <> ''),
  path_key    TEXT NOT NULL,  -- the path in upper case
  content     BLOB,           -- NULL: deleted
  modified_at INTEGER NOT NULL,
  caller      TEXT
) STRICT;
CREATE INDEX file_histories ON file_revisions (path_key, revision);

-- The revision in force of each file.
CREATE TABLE files (
  path_key TEXT PRIMARY KEY,
  revision INTEGER NOT NULL REFERENCES file_revisions (revision)
) STRICT, WITHOUT ROWID;

CREATE TABLE setups (
  name        TEXT PRIMARY KEY CHECK (name <> ''),
  text        TEXT NOT NULL,
  modified_at INTEGER NOT NULL,
  caller      TEXT
) STRICT;

CREATE TABLE runs (
  id          INTEGER PRIMARY KEY AUTOINCREMENT,
  -- queued, running, completed, stopped, failed, limit_exceeded, cancelled
  status      INTEGER NOT NULL CHECK (status BETWEEN 1 AND 7),
  program     TEXT NOT NULL,
  program_key TEXT NOT NULL,  -- the path in upper case
  request     TEXT NOT NULL,
  result      TEXT NOT NULL,
  created_at  INTEGER NOT NULL,
  finished_at INTEGER,
  caller      TEXT,
  CHECK ((status >= 3) = (finished_at IS NOT NULL))
) STRICT;
CREATE INDEX run_ages ON runs (finished_at) WHERE finished_at IS NOT NULL;

CREATE TABLE run_traces (
  run   INTEGER PRIMARY KEY REFERENCES runs (id) ON DELETE CASCADE,
  trace BLOB NOT NULL
) STRICT;

CREATE TABLE run_files (
  run      INTEGER NOT NULL REFERENCES runs (id) ON DELETE CASCADE,
  name_key TEXT NOT NULL,  -- the file name in upper case
  path     TEXT NOT NULL,
  content  BLOB NOT NULL,
  PRIMARY KEY (run, name_key, path)
) STRICT;

-- The schema of the first release. A released migration is never changed: a test holds its digest.
-- Times are ns since 1970 (UTC), lengths nm. Codes are those of the enumerations in db/store, which are checked where
-- a row is read: a list of codes in a CHECK could not grow.
-- `seal`: SHA-256 of the row's other columns (db/sqlite/row_digest.hpp) where nothing else can tell what was stored, so
-- that verify and every reader notice a changed one.

CREATE TABLE schema_migrations (
  number     INTEGER PRIMARY KEY,
  name       TEXT NOT NULL,
  checksum   BLOB NOT NULL CHECK (length(checksum) = 32),  -- SHA-256 of the migration's text
  applied_at INTEGER NOT NULL
) STRICT;

-- Written to find out whether commits work again after one has failed.
CREATE TABLE storage_probe (
  id        INTEGER PRIMARY KEY CHECK (id = 1),
  probed_at INTEGER NOT NULL
) STRICT;
INSERT INTO storage_probe VALUES (1, 0);

-- Immutable revisions of the tolerance tables. Revisions that differ in custom columns alone share one set.

CREATE TABLE table_sets (
  id     INTEGER PRIMARY KEY,
  digest BLOB NOT NULL UNIQUE CHECK (length(digest) = 32),
  seal   BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;

-- The cells of the standard.
CREATE TABLE table_cells (
  table_set   INTEGER NOT NULL REFERENCES table_sets (id),
  table_name  TEXT NOT NULL,
  column_name TEXT NOT NULL,
  over_nm     INTEGER NOT NULL CHECK (over_nm >= 0),
  up_to_nm    INTEGER NOT NULL CHECK (up_to_nm > over_nm),
  value_nm    INTEGER,  -- NULL: the standard defines nothing there
  PRIMARY KEY (table_set, table_name, column_name, over_nm)
) STRICT, WITHOUT ROWID;

CREATE TABLE table_revisions (
  number     INTEGER PRIMARY KEY,
  digest     BLOB NOT NULL CHECK (length(digest) = 32),  -- of the standard's and the custom cells
  table_set  INTEGER NOT NULL REFERENCES table_sets (id),
  source     TEXT NOT NULL,
  created_at INTEGER NOT NULL,
  parent     INTEGER REFERENCES table_revisions (number) CHECK (parent < number),
  caller     TEXT,
  seal       BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;

-- A shop's own columns, complete for each revision.
CREATE TABLE custom_cells (
  revision    INTEGER NOT NULL REFERENCES table_revisions (number),
  table_name  TEXT NOT NULL,
  column_name TEXT NOT NULL,
  over_nm     INTEGER NOT NULL CHECK (over_nm >= 0),
  up_to_nm    INTEGER NOT NULL CHECK (up_to_nm > over_nm),
  upper_nm    INTEGER NOT NULL,
  lower_nm    INTEGER NOT NULL CHECK (lower_nm <= upper_nm),
  PRIMARY KEY (revision, table_name, column_name, over_nm)
) STRICT, WITHOUT ROWID;

-- What a centre calls the revisions that came from it: records name them so.
CREATE TABLE table_revision_ids (
  revision INTEGER PRIMARY KEY REFERENCES table_revisions (number),
  id       TEXT NOT NULL,
  seal     BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;

-- Measurements: kept for ever, never changed; db/store/measurement_row.hpp says what each column means.

CREATE TABLE measurements (
  id                 INTEGER PRIMARY KEY,
  source             INTEGER NOT NULL,
  measured_at        INTEGER NOT NULL,
  received_at        INTEGER NOT NULL,
  nominal_nm         INTEGER NOT NULL,
  tolerance_class    TEXT,
  feature            INTEGER NOT NULL,
  upper_deviation_nm INTEGER NOT NULL,
  lower_deviation_nm INTEGER NOT NULL,
  size_over_nm       INTEGER,
  size_up_to_nm      INTEGER,
  basis              INTEGER NOT NULL,
  table_revision     INTEGER,  -- of table_revisions, or below 0 of origin_revisions: checked once a batch
  measured_nm        INTEGER NOT NULL,
  corrected_nm       INTEGER,  -- at 20 degrees Celsius, where an expansion was given
  verdict            INTEGER NOT NULL,
  rule               INTEGER NOT NULL,
  uncertainty_nm     INTEGER CHECK (uncertainty_nm >= 0),
  uncertainty_budget TEXT,     -- of the gauge in use
  coverage_factor    INTEGER CHECK (coverage_factor >= 0),                    -- in 1e-6
  probability        INTEGER CHECK (probability BETWEEN 500000 AND 999999),   -- asked for, in 1e-6
  conformance        INTEGER CHECK (conformance BETWEEN 0 AND 1000000000),    -- found, in 1e-9
  guard_band         INTEGER CHECK (guard_band >= 0),                         -- in fm
  temperature        INTEGER,  -- temperatures and coefficients of expansion in 1e-6
  scale_temperature  INTEGER,
  part_expansion     INTEGER,
  scale_expansion    INTEGER,
  part_material      TEXT,
  scale_material     TEXT,
  part_id            TEXT,
  characteristic     TEXT,
  subgroup           TEXT,
  work_order         TEXT,
  operation          TEXT,
  machine            TEXT,
  operator           TEXT,
  gauge              TEXT,
  calibration_due    TEXT,     -- where it was overdue
  unit               TEXT,
  comment            TEXT,
  caller             TEXT,
  run_id             INTEGER,
  cycle              INTEGER,
  correction_of      INTEGER REFERENCES measurements (id),
  correction_reason  TEXT,
  origin             INTEGER,  -- of origins; 0: of this folder
  seq                INTEGER,  -- in the log of its origin; NULL: it is the id
  number             INTEGER,  -- in the id it got there; NULL: it is the seq
  corrected_origin   INTEGER,  -- what correction_of is called there, where it is of another folder
  corrected_number   INTEGER,
  hash               BLOB NOT NULL CHECK (length(hash) = 32),  -- of its leaf in the log

  CHECK (lower_deviation_nm <= upper_deviation_nm),
  CHECK ((table_revision IS NULL) = (tolerance_class IS NULL)),
  CHECK ((size_over_nm IS NULL) = (size_up_to_nm IS NULL)),
  -- What guards a limit has its figures: rule 2 (guard_band) k, rule 3 (conformance) what was asked for and found; the
  -- simple rule (1) decides always.
  CHECK (rule <> 2 OR coverage_factor IS NOT NULL),
  CHECK (rule <> 3 OR probability IS NOT NULL),
  CHECK ((probability IS NULL) = (conformance IS NULL) AND (probability IS NULL) = (guard_band IS NULL)),
  CHECK (uncertainty_nm IS NOT NULL OR (rule = 1 AND probability IS NULL AND uncertainty_budget IS NULL)),
  CHECK (verdict <> 4 OR rule <> 1),
  CHECK ((correction_of IS NULL) = (correction_reason IS NULL)),
  CHECK (correction_of < id),
  -- A gauged part has a size; what is measured in a cycle may be a coordinate.
  CHECK (cycle IS NOT NULL OR measured_nm > 0),
  -- What a gauge (source 1) found good (verdict 1) lies within its limits.
  CHECK (source <> 1 OR verdict <> 1 OR
         coalesce(corrected_nm, measured_nm) BETWEEN nominal_nm + lower_deviation_nm
                                                 AND nominal_nm + upper_deviation_nm)
) STRICT;
CREATE UNIQUE INDEX measurement_origins ON measurements (origin, seq) WHERE origin IS NOT NULL;
CREATE UNIQUE INDEX measurement_numbers ON measurements (origin, number) WHERE number IS NOT NULL;
-- Two folders may have corrected the same record before they heard of each other: both are kept.
CREATE INDEX measurement_corrections ON measurements (correction_of) WHERE correction_of IS NOT NULL;

CREATE TRIGGER measurements_are_not_updated BEFORE UPDATE ON measurements
BEGIN SELECT RAISE(ABORT, 'a measurement is never changed: store a correction'); END;
CREATE TRIGGER measurements_are_not_deleted BEFORE DELETE ON measurements
BEGIN SELECT RAISE(ABORT, 'a measurement is never deleted'); END;

-- What was found to be the cause of a measurement and what was done about it: notes beside the record, kept for ever as
-- well, and no part of the log.

CREATE TABLE notes (
  id          INTEGER PRIMARY KEY,
  measurement INTEGER NOT NULL REFERENCES measurements (id),
  cause       TEXT,
  measure     TEXT,
  text        TEXT,
  operator    TEXT,
  caller      TEXT,
  received_at INTEGER NOT NULL,
  seal        BLOB NOT NULL CHECK (length(seal) = 32),
  CHECK (coalesce(cause, measure, text) IS NOT NULL)
) STRICT;
CREATE INDEX notes_of_measurements ON notes (measurement);
CREATE INDEX notes_of_causes ON notes (cause, measurement) WHERE cause IS NOT NULL;

CREATE TRIGGER notes_are_not_updated BEFORE UPDATE ON notes
BEGIN SELECT RAISE(ABORT, 'a note is never changed: add another'); END;
CREATE TRIGGER notes_are_not_deleted BEFORE DELETE ON notes
BEGIN SELECT RAISE(ABORT, 'a note is never deleted'); END;

-- The index of the measurements, filled in blocks of 1024 rows by the writer's maintenance and made from the
-- measurements alone: an index kept up with every insert would cost it two to four times its time. A query takes the
-- rows up to the last block from here and scans the rest.

-- A node of level n covers 1024 * 32^n rows: node 0 of level 0 the ids 1 to 1024.
CREATE TABLE measurement_nodes (
  level           INTEGER NOT NULL CHECK (level BETWEEN 0 AND 3),
  node            INTEGER NOT NULL,
  min_measured_at INTEGER NOT NULL,
  max_measured_at INTEGER NOT NULL,
  min_received_at INTEGER NOT NULL,
  max_received_at INTEGER NOT NULL,
  stale           INTEGER NOT NULL DEFAULT 0,  -- 1: a row was corrected, the aggregates are to be made anew
  PRIMARY KEY (level, node)
) STRICT, WITHOUT ROWID;
CREATE INDEX stale_measurement_nodes ON measurement_nodes (level, node) WHERE stale = 1;

-- Which rows of a block have a value: db/store/measurement_index.hpp names the fields.
CREATE TABLE measurement_postings (
  field INTEGER NOT NULL,
  value TEXT NOT NULL,
  block INTEGER NOT NULL,
  rows  BLOB NOT NULL,  -- 128 bytes: a bit for each row; else two bytes for each
  PRIMARY KEY (field, value, block)
) STRICT, WITHOUT ROWID;

-- The values of a block in one piece, for figures of many of them: db/store/value_block.hpp. Blocks with a correction, or
-- with a row of another folder, have none: their rows are read.
CREATE TABLE measurement_values (
  block INTEGER PRIMARY KEY,
  bytes BLOB NOT NULL
) STRICT;

-- Counts and exact sums of a node's current rows by the value of a field, which is 0 where the rows have none. A node
-- with too many values of a field has no aggregates for it.
CREATE TABLE measurement_aggregates (
  level      INTEGER NOT NULL,
  node       INTEGER NOT NULL,
  field      INTEGER NOT NULL,
  value      ANY NOT NULL,
  kind       INTEGER NOT NULL,  -- 8 * source + verdict
  statistics BLOB NOT NULL,
  PRIMARY KEY (level, node, field, value, kind)
) STRICT, WITHOUT ROWID;

-- API keys, and the answers kept for requests with an Idempotency-Key.

CREATE TABLE api_keys (
  id         INTEGER PRIMARY KEY,
  name       TEXT NOT NULL CHECK (name <> ''),
  role       INTEGER NOT NULL,
  token_hash BLOB NOT NULL CHECK (length(token_hash) = 32),
  created_at INTEGER NOT NULL,
  revoked_at INTEGER,
  seal       BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;
CREATE UNIQUE INDEX api_key_names ON api_keys (name) WHERE revoked_at IS NULL;
CREATE UNIQUE INDEX api_key_tokens ON api_keys (token_hash);

CREATE TABLE idempotent_answers (
  id           INTEGER PRIMARY KEY,
  caller       TEXT NOT NULL,
  method       TEXT NOT NULL,
  path         TEXT NOT NULL,
  key          TEXT NOT NULL CHECK (key <> ''),
  body_digest  BLOB NOT NULL CHECK (length(body_digest) = 32),
  status       INTEGER NOT NULL CHECK (status BETWEEN 200 AND 299),
  content_type TEXT NOT NULL,
  location     TEXT NOT NULL,
  body         BLOB NOT NULL,
  expires_at   INTEGER NOT NULL,
  measurement  INTEGER,  -- the newest there was when the answer was kept: it is forwarded with that one
  seal         BLOB NOT NULL CHECK (length(seal) = 32),
  UNIQUE (key, caller, method, path)
) STRICT;
CREATE INDEX idempotent_answer_expiry ON idempotent_answers (expires_at);
CREATE INDEX idempotent_answer_measurements ON idempotent_answers (measurement) WHERE measurement IS NOT NULL;

-- The control's disk with its revisions, and runs. Names are found by their upper case.

CREATE TABLE file_revisions (
  revision    INTEGER PRIMARY KEY AUTOINCREMENT,
  path        TEXT NOT NULL CHECK (path <> ''),
  path_key    TEXT NOT NULL,
  content     BLOB,  -- NULL: deleted
  modified_at INTEGER NOT NULL,
  caller      TEXT,
  seal        BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;
CREATE INDEX file_histories ON file_revisions (path_key, revision);

-- The revision in force of each file.
CREATE TABLE files (
  path_key TEXT PRIMARY KEY,
  revision INTEGER NOT NULL REFERENCES file_revisions (revision)
) STRICT, WITHOUT ROWID;

CREATE TABLE runs (
  id          INTEGER PRIMARY KEY AUTOINCREMENT,
  status      INTEGER NOT NULL,
  program     TEXT NOT NULL,
  program_key TEXT NOT NULL,
  request     TEXT NOT NULL,
  result      TEXT NOT NULL,
  created_at  INTEGER NOT NULL,
  finished_at INTEGER,
  caller      TEXT,
  seal        BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;
CREATE INDEX run_ages ON runs (finished_at) WHERE finished_at IS NOT NULL;

CREATE TABLE run_traces (
  run   INTEGER PRIMARY KEY REFERENCES runs (id) ON DELETE CASCADE,
  trace BLOB NOT NULL,
  seal  BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;

CREATE TABLE run_files (
  run      INTEGER NOT NULL REFERENCES runs (id) ON DELETE CASCADE,
  name_key TEXT NOT NULL,
  path     TEXT NOT NULL,
  content  BLOB NOT NULL,
  seal     BLOB NOT NULL CHECK (length(seal) = 32),
  PRIMARY KEY (run, name_key, path)
) STRICT;

-- For replay. AUTOINCREMENT: the id of an event that was purged is never used again.
CREATE TABLE events (
  id         INTEGER PRIMARY KEY AUTOINCREMENT,
  type       TEXT NOT NULL,
  payload    TEXT NOT NULL,
  created_at INTEGER NOT NULL,
  seal       BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;

-- Whatever is kept as a text under a name: setups, plans, gauges in use, connections.
CREATE TABLE documents (
  kind        INTEGER NOT NULL,
  name        TEXT NOT NULL CHECK (name <> ''),
  text        TEXT NOT NULL,
  modified_at INTEGER NOT NULL,
  caller      TEXT,
  seal        BLOB NOT NULL CHECK (length(seal) = 32),
  PRIMARY KEY (kind, name)
) STRICT;

-- The log of this data folder: what makes it one of many, and the tree over its measurements.

CREATE TABLE log (
  id     INTEGER PRIMARY KEY CHECK (id = 1),
  origin BLOB NOT NULL CHECK (length(origin) = 16),  -- random: no other folder has it
  name   TEXT,                                       -- in its checkpoints, from the first start on
  size   INTEGER NOT NULL,                           -- rows that are in the tree
  seal   BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;
WITH made (origin) AS MATERIALIZED (SELECT randomblob(16))
INSERT INTO log SELECT 1, origin, NULL, 0, row_digest(origin, NULL, 0) FROM made;

-- The public keys that have signed checkpoints.
CREATE TABLE log_keys (
  number     INTEGER PRIMARY KEY,
  vkey       TEXT NOT NULL UNIQUE,
  created_at INTEGER NOT NULL,
  seal       BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;

-- Roots of 256^level leaves, made after the commit from the measurements' hashes alone.
CREATE TABLE log_nodes (
  level INTEGER NOT NULL CHECK (level BETWEEN 1 AND 7),
  node  INTEGER NOT NULL,
  hash  BLOB NOT NULL CHECK (length(hash) = 32),
  PRIMARY KEY (level, node)
) STRICT, WITHOUT ROWID;

-- The logs of other data folders, whose stations forward their records here.

CREATE TABLE origins (
  number     INTEGER PRIMARY KEY CHECK (number > 0),
  digits     TEXT NOT NULL UNIQUE CHECK (length(digits) = 16),  -- what its ids end with
  first_row  INTEGER,           -- the id of its first row here; NULL: none came yet
  size       INTEGER NOT NULL,  -- rows of it that are here
  checkpoint TEXT NOT NULL,     -- the signed head of so many rows; empty before the first
  seal       BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;

-- The public keys whose checkpoints are taken: the first on trust, each further one signed for by one before it.
CREATE TABLE origin_keys (
  number     INTEGER PRIMARY KEY,
  origin     INTEGER NOT NULL REFERENCES origins (number),
  vkey       TEXT NOT NULL UNIQUE,
  created_at INTEGER NOT NULL,
  seal       BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;

-- As log_nodes.
CREATE TABLE origin_nodes (
  origin INTEGER NOT NULL,
  level  INTEGER NOT NULL CHECK (level BETWEEN 1 AND 7),
  node   INTEGER NOT NULL,
  hash   BLOB NOT NULL CHECK (length(hash) = 32),
  PRIMARY KEY (origin, level, node)
) STRICT, WITHOUT ROWID;

-- Signed heads that contradict the one above: the folder was copied and started twice.
CREATE TABLE origin_forks (
  number     INTEGER PRIMARY KEY,
  origin     INTEGER NOT NULL REFERENCES origins (number),
  checkpoint TEXT NOT NULL UNIQUE,
  created_at INTEGER NOT NULL,
  seal       BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;

-- Table revisions that judged such records and that this folder does not have, and editions of other standards. Rows
-- name them by the negative number.
CREATE TABLE origin_revisions (
  number INTEGER PRIMARY KEY CHECK (number > 0),
  id     TEXT NOT NULL UNIQUE,
  seal   BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;

-- What the centre that this folder forwards to has confirmed.
CREATE TABLE forwarding (
  id     INTEGER PRIMARY KEY CHECK (id = 1),
  centre TEXT NOT NULL,
  size   INTEGER NOT NULL,
  seal   BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;

-- What a centre hands on to its stations, in the order of its changes: which table, key, document or correction of a
-- station's record it is (db/store/revisions_store.hpp). What it is now stands where it is kept.

CREATE TABLE revisions (
  number  INTEGER PRIMARY KEY AUTOINCREMENT,
  tag     BLOB NOT NULL CHECK (length(tag) = 8),  -- random: after an older copy was put back a number is given again
  kind    INTEGER NOT NULL,
  name    TEXT NOT NULL,
  station INTEGER  -- of origins; NULL: for all of them
) STRICT;
CREATE INDEX revision_names ON revisions (kind, name, number);

CREATE TRIGGER table_revisions_are_handed_on AFTER INSERT ON table_revisions WHEN NEW.parent IS NOT NULL
BEGIN INSERT INTO revisions (tag, kind, name) VALUES (randomblob(8), 1, ''); END;

-- Those of viewers and operators: administrators and stations have theirs at one place.
CREATE TRIGGER api_keys_are_handed_on AFTER INSERT ON api_keys WHEN NEW.role IN (1, 2)
BEGIN INSERT INTO revisions (tag, kind, name) VALUES (randomblob(8), 2, NEW.name); END;
CREATE TRIGGER revoked_api_keys_are_handed_on AFTER UPDATE OF revoked_at ON api_keys WHEN NEW.role IN (1, 2)
BEGIN INSERT INTO revisions (tag, kind, name) VALUES (randomblob(8), 2, NEW.name); END;

-- Setups, plans, and the catalogues that plans name.
CREATE TRIGGER documents_are_handed_on AFTER INSERT ON documents WHEN NEW.kind IN (3, 4, 7)
BEGIN INSERT INTO revisions (tag, kind, name) VALUES (randomblob(8), NEW.kind, NEW.name); END;
CREATE TRIGGER deleted_documents_are_handed_on AFTER DELETE ON documents WHEN OLD.kind IN (3, 4, 7)
BEGIN INSERT INTO revisions (tag, kind, name) VALUES (randomblob(8), OLD.kind, OLD.name); END;

-- What this folder has of its centre.
CREATE TABLE received (
  kind   INTEGER NOT NULL,
  name   TEXT NOT NULL,
  number INTEGER NOT NULL,  -- of the revision there
  digest BLOB NOT NULL CHECK (length(digest) = 32),  -- what it was here then: another is of this folder
  seal   BLOB NOT NULL CHECK (length(seal) = 32),
  PRIMARY KEY (kind, name)
) STRICT;

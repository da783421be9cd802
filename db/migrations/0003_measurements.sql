-- Measurements: kept for ever, never changed. Lengths in nm, times in ns since 1970 (UTC).
-- The codes are those of db/store/measurement_row.hpp. They are checked with BETWEEN: for IN with
-- three values or more SQLite builds a temporary index at every row.

CREATE TABLE measurements (
  id                 INTEGER PRIMARY KEY,
  source             INTEGER NOT NULL CHECK (source BETWEEN 1 AND 2),  -- gauge, simulation
  measured_at        INTEGER NOT NULL,
  received_at        INTEGER NOT NULL,
  nominal_nm         INTEGER NOT NULL,
  tolerance_class    TEXT,
  feature            INTEGER NOT NULL CHECK (feature BETWEEN 1 AND 2),  -- hole, shaft
  upper_deviation_nm INTEGER NOT NULL,
  lower_deviation_nm INTEGER NOT NULL,
  size_over_nm       INTEGER,
  size_up_to_nm      INTEGER,
  basis              INTEGER NOT NULL CHECK (basis BETWEEN 1 AND 3),  -- iso286, custom, explicit
  table_revision     INTEGER,  -- of table_revisions: checked once a batch, not at every row
  measured_nm        INTEGER NOT NULL,
  verdict            INTEGER NOT NULL CHECK (verdict BETWEEN 1 AND 4),  -- good, rework, reject, indeterminate
  rule               INTEGER NOT NULL CHECK (rule BETWEEN 1 AND 2),           -- simple, guard_band
  uncertainty_nm     INTEGER CHECK (uncertainty_nm >= 0),
  coverage_factor    INTEGER CHECK (coverage_factor >= 0),  -- k in millionths
  part_id            TEXT,
  characteristic     TEXT,
  work_order         TEXT,
  operation          TEXT,
  machine            TEXT,
  operator           TEXT,
  gauge              TEXT,
  temperature        INTEGER,  -- millionths of a degree Celsius
  unit               TEXT,
  comment            TEXT,
  caller             TEXT,
  run_id             INTEGER,
  cycle              INTEGER,
  correction_of      INTEGER REFERENCES measurements (id),
  correction_reason  TEXT,
  hash               BLOB NOT NULL CHECK (length(hash) = 32),  -- db/store/measurement_hash.hpp

  CHECK (lower_deviation_nm <= upper_deviation_nm),
  CHECK ((basis = 3) = (table_revision IS NULL)),
  CHECK ((basis = 3) = (tolerance_class IS NULL)),
  CHECK ((size_over_nm IS NULL) = (size_up_to_nm IS NULL)),
  CHECK (rule = 1 OR (uncertainty_nm IS NOT NULL AND coverage_factor IS NOT NULL)),
  CHECK (verdict <> 4 OR rule = 2),
  CHECK ((correction_of IS NULL) = (correction_reason IS NULL)),
  CHECK (correction_of < id),
  -- A gauged part has a size, and is never good outside its limits.
  CHECK (source = 2 OR measured_nm > 0),
  CHECK (source = 2 OR verdict <> 1 OR
         measured_nm BETWEEN nominal_nm + lower_deviation_nm AND nominal_nm + upper_deviation_nm)
) STRICT;

-- A row is corrected at most once: corrections form chains, and the last row of one is current.
CREATE UNIQUE INDEX measurement_corrections ON measurements (correction_of)
  WHERE correction_of IS NOT NULL;

CREATE TRIGGER measurements_are_not_updated BEFORE UPDATE ON measurements
BEGIN SELECT RAISE(ABORT, 'a measurement is never changed: store a correction'); END;

CREATE TRIGGER measurements_are_not_deleted BEFORE DELETE ON measurements
BEGIN SELECT RAISE(ABORT, 'a measurement is never deleted'); END;

-- What makes filters fast, filled in blocks of rows while nothing else is written: an index kept up
-- with every insert would cost it two to four times its time. A query takes the rows up to the last
-- block from here and scans the rest.
CREATE TABLE measurement_blocks (
  first_id        INTEGER PRIMARY KEY,
  last_id         INTEGER NOT NULL CHECK (last_id >= first_id),
  min_measured_at INTEGER NOT NULL,
  max_measured_at INTEGER NOT NULL
) STRICT;

CREATE TABLE measurement_lookup (
  field       INTEGER NOT NULL CHECK (field BETWEEN 1 AND 4),  -- part_id, order, characteristic, machine
  value       TEXT NOT NULL,
  measurement INTEGER NOT NULL,
  PRIMARY KEY (field, value, measurement)
) STRICT, WITHOUT ROWID;

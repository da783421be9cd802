-- The index of the measurements, filled in blocks of 1024 rows by the writer's maintenance and made
-- from the measurements alone. A query takes the rows up to the last block from here and scans the
-- rest.

DROP TABLE measurement_lookup;
DROP TABLE measurement_blocks;

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

-- Counts and exact sums of a node's current rows by the value of a field, which is 0 where the rows
-- have none. A node with too many values of a field has no aggregates for it.
CREATE TABLE measurement_aggregates (
  level      INTEGER NOT NULL,
  node       INTEGER NOT NULL,
  field      INTEGER NOT NULL,
  value      ANY NOT NULL,
  kind       INTEGER NOT NULL,  -- 8 * source + verdict
  statistics BLOB NOT NULL,
  PRIMARY KEY (level, node, field, value, kind)
) STRICT, WITHOUT ROWID;

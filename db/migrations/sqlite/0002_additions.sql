-- What the correction to 20 degrees adds to the uncertainty of a size, and what that was computed from: standard
-- uncertainties, NULL in the rows before.

PRAGMA ignore_check_constraints = ON;  -- else each column that is added holds all rows to the constraints of the table
ALTER TABLE measurements ADD COLUMN temperature_uncertainty INTEGER CHECK (temperature_uncertainty >= 0);  -- in 1e-6
ALTER TABLE measurements ADD COLUMN scale_temperature_uncertainty INTEGER CHECK (scale_temperature_uncertainty >= 0);
ALTER TABLE measurements ADD COLUMN part_expansion_uncertainty INTEGER CHECK (part_expansion_uncertainty >= 0);
ALTER TABLE measurements ADD COLUMN scale_expansion_uncertainty INTEGER CHECK (scale_expansion_uncertainty >= 0);
ALTER TABLE measurements ADD COLUMN added_uncertainty INTEGER  -- in pm
  CHECK (added_uncertainty IS NULL OR (added_uncertainty >= 0 AND corrected_nm IS NOT NULL));
PRAGMA ignore_check_constraints = OFF;

-- For summaries that filter by one field and group by another.

-- Whether a node has what follows of its current rows. 0: a row was corrected, or the node is of an earlier release; the
-- writer's maintenance makes it.
ALTER TABLE measurement_nodes ADD COLUMN paired INTEGER NOT NULL DEFAULT 0;
CREATE INDEX unpaired_measurement_nodes ON measurement_nodes (level, node) WHERE paired = 0;

-- What the rows of a block are filtered and grouped by, column by column: db/store/block_columns.hpp.
CREATE TABLE measurement_columns (
  block INTEGER PRIMARY KEY,
  bytes BLOB NOT NULL
) STRICT;

-- Counts and exact sums of the current rows of a node above blocks by the values of two fields, where they are few
-- enough: db/store/pair_statistics.hpp.
CREATE TABLE measurement_pairs (
  level    INTEGER NOT NULL,
  field    INTEGER NOT NULL,
  by_field INTEGER NOT NULL,
  node     INTEGER NOT NULL,
  bytes    BLOB NOT NULL,
  PRIMARY KEY (level, field, by_field, node)
) STRICT, WITHOUT ROWID;

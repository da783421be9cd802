-- Immutable revisions of the tolerance tables. Sizes and deviations in nm.

-- The cells of the standard; revisions that differ in custom columns alone share one set.
CREATE TABLE table_sets (
  id     INTEGER PRIMARY KEY,
  digest BLOB NOT NULL UNIQUE CHECK (length(digest) = 32)
) STRICT;

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
  caller     TEXT
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

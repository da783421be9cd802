-- The values of a block of 1024 rows in one piece, for figures of many of them: db/store/value_block.hpp.
-- Blocks with a correction, or with a row of another folder, have none: their rows are read.
-- The index is made anew, with the values.

CREATE TABLE measurement_values (
  block  INTEGER PRIMARY KEY,
  bytes  BLOB NOT NULL
) STRICT;

DELETE FROM measurement_nodes;
DELETE FROM measurement_postings;
DELETE FROM measurement_aggregates;

-- What cannot be derived from other rows is sealed: with a digest of its other columns
-- (db/sqlite/row_digest.hpp), so that verify and every reader notice a bit that flipped.
-- NULL: stored before this migration.

ALTER TABLE api_keys ADD COLUMN seal BLOB CHECK (length(seal) = 32);
ALTER TABLE idempotent_answers ADD COLUMN seal BLOB CHECK (length(seal) = 32);
ALTER TABLE file_revisions ADD COLUMN seal BLOB CHECK (length(seal) = 32);
ALTER TABLE setups ADD COLUMN seal BLOB CHECK (length(seal) = 32);
ALTER TABLE runs ADD COLUMN seal BLOB CHECK (length(seal) = 32);
ALTER TABLE run_traces ADD COLUMN seal BLOB CHECK (length(seal) = 32);
ALTER TABLE run_files ADD COLUMN seal BLOB CHECK (length(seal) = 32);
ALTER TABLE events ADD COLUMN seal BLOB CHECK (length(seal) = 32);
ALTER TABLE table_sets ADD COLUMN seal BLOB CHECK (length(seal) = 32);
ALTER TABLE table_revisions ADD COLUMN seal BLOB CHECK (length(seal) = 32);

-- What was found to be the cause of a measurement and what was done about it: notes beside the record, which stays as it
-- is. They are kept for ever as well, and are no part of the log.

CREATE TABLE notes (
  id          INTEGER PRIMARY KEY,
  measurement INTEGER NOT NULL REFERENCES measurements (id),
  cause       TEXT,
  measure     TEXT,
  text        TEXT,
  operator    TEXT,
  caller      TEXT,
  received_at INTEGER NOT NULL,
  seal        BLOB NOT NULL CHECK (length(seal) = 32),  -- db/sqlite/row_digest.hpp
  CHECK (coalesce(cause, measure, text) IS NOT NULL)
) STRICT;
CREATE INDEX notes_of_measurements ON notes (measurement);

CREATE TRIGGER notes_are_not_updated BEFORE UPDATE ON notes
BEGIN SELECT RAISE(ABORT, 'a note is never changed: add another'); END;

CREATE TRIGGER notes_are_not_deleted BEFORE DELETE ON notes
BEGIN SELECT RAISE(ABORT, 'a note is never deleted'); END;

-- What causes and measures there are to choose from is a document.
PRAGMA writable_schema = ON;
UPDATE sqlite_schema SET sql = replace(sql, 'CHECK (kind BETWEEN 1 AND 6)', 'CHECK (kind BETWEEN 1 AND 7)')
  WHERE type = 'table' AND name = 'documents';
UPDATE sqlite_schema SET sql = replace(sql, 'CHECK (kind BETWEEN 1 AND 5)', 'CHECK (kind BETWEEN 1 AND 7)')
  WHERE type = 'table' AND name = 'revisions';
PRAGMA writable_schema = RESET;

-- A centre's plans name its catalogues, so these are handed on too.
CREATE TRIGGER catalogues_are_handed_on AFTER INSERT ON documents WHEN NEW.kind = 7
BEGIN INSERT INTO revisions (tag, kind, name) VALUES (randomblob(8), 7, NEW.name); END;
CREATE TRIGGER deleted_catalogues_are_handed_on AFTER DELETE ON documents WHEN OLD.kind = 7
BEGIN INSERT INTO revisions (tag, kind, name) VALUES (randomblob(8), 7, OLD.name); END;

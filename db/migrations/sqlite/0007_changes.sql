-- Each change of a table, a document or a key, in the order of a tree of its own: the ids are 1, 2, … without gaps.

CREATE TABLE changes (
  id          INTEGER PRIMARY KEY,
  at          INTEGER NOT NULL,
  caller      TEXT,
  kind        TEXT NOT NULL,
  name        TEXT NOT NULL,
  action      TEXT NOT NULL,
  before_text TEXT,  -- NULL: it was not there
  after_text  TEXT,  -- NULL: it is gone
  leaf        BLOB NOT NULL CHECK (length(leaf) = 32),
  seal        BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;
CREATE INDEX changes_by_name ON changes (kind, name, id);
CREATE TRIGGER changes_are_not_updated BEFORE UPDATE ON changes
BEGIN SELECT RAISE(ABORT, 'a change is never altered'); END;
CREATE TRIGGER changes_are_not_deleted BEFORE DELETE ON changes
BEGIN SELECT RAISE(ABORT, 'a change is never deleted'); END;

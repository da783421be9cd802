-- At a centre: the notes that a station has forwarded, and the number in the id that each got there.

CREATE TABLE note_origins (
  note   INTEGER PRIMARY KEY REFERENCES notes (id),
  origin INTEGER NOT NULL REFERENCES origins (number),
  number INTEGER NOT NULL CHECK (number > 0),
  seal   BLOB NOT NULL CHECK (length(seal) = 32),
  UNIQUE (origin, number)
) STRICT;
CREATE TRIGGER note_origins_are_not_updated BEFORE UPDATE ON note_origins
BEGIN SELECT RAISE(ABORT, 'a note is never changed: add another'); END;
CREATE TRIGGER note_origins_are_not_deleted BEFORE DELETE ON note_origins
BEGIN SELECT RAISE(ABORT, 'a note is never deleted'); END;

-- Histories: a log that an older copy was put back of goes on as a branch, under an origin of its own.

-- The histories before the one that `log` names, the oldest first, and what of each went on in the next: the newest
-- numbers in ids that it gave out.
CREATE TABLE log_branches (
  number     INTEGER PRIMARY KEY,
  origin     BLOB NOT NULL CHECK (length(origin) = 16),
  name       TEXT NOT NULL,
  size       INTEGER NOT NULL,  -- rows of its tree
  last_row   INTEGER NOT NULL,
  last_run   INTEGER NOT NULL,
  last_event INTEGER NOT NULL,
  last_note  INTEGER NOT NULL,
  seal       BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;

-- 'copy': in a copy that `backup` made, until that one is started. 'forked': the centre has another log of this name,
-- and no measurement is taken.
CREATE TABLE log_marks (
  mark   TEXT PRIMARY KEY,
  reason TEXT NOT NULL,
  seal   BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT, WITHOUT ROWID;

-- At a centre: the log that a branch begins with, and how many of its rows.
CREATE TABLE origin_bases (
  origin INTEGER PRIMARY KEY REFERENCES origins (number),
  base   INTEGER NOT NULL REFERENCES origins (number) CHECK (base < origin),
  size   INTEGER NOT NULL CHECK (size > 0),
  seal   BLOB NOT NULL CHECK (length(seal) = 32)
) STRICT;

-- Records of other data folders, which stations forward: a row says whose it is and where it stands
-- in that log. A folder without such rows has none of the new columns filled.

ALTER TABLE measurements ADD COLUMN origin INTEGER;  -- of origins; 0: of this folder
ALTER TABLE measurements ADD COLUMN seq INTEGER;     -- in the log of its origin; NULL: it is the id
ALTER TABLE measurements ADD COLUMN number INTEGER;  -- in the id it got there; NULL: it is the seq
ALTER TABLE measurements ADD COLUMN corrected_origin INTEGER;  -- what correction_of is called there,
ALTER TABLE measurements ADD COLUMN corrected_number INTEGER;  -- where it is of another folder
CREATE UNIQUE INDEX measurement_origins ON measurements (origin, seq) WHERE origin IS NOT NULL;
CREATE UNIQUE INDEX measurement_numbers ON measurements (origin, number) WHERE number IS NOT NULL;

-- Two folders may have corrected the same record before they heard of each other: both are kept.
DROP INDEX measurement_corrections;
CREATE INDEX measurement_corrections ON measurements (correction_of)
  WHERE correction_of IS NOT NULL;

CREATE TABLE origins (
  number     INTEGER PRIMARY KEY CHECK (number > 0),
  digits     TEXT NOT NULL UNIQUE CHECK (length(digits) = 16),  -- what its ids end with
  first_row  INTEGER,           -- the id of its first row here; NULL: none came yet
  size       INTEGER NOT NULL,  -- rows of it that are here
  checkpoint TEXT NOT NULL,     -- the signed head of so many rows; empty before the first
  seal       BLOB CHECK (length(seal) = 32)
) STRICT;

-- The public keys whose checkpoints are taken: the first on trust, each further one signed for by
-- one before it.
CREATE TABLE origin_keys (
  number     INTEGER PRIMARY KEY,
  origin     INTEGER NOT NULL REFERENCES origins (number),
  vkey       TEXT NOT NULL UNIQUE,
  created_at INTEGER NOT NULL,
  seal       BLOB CHECK (length(seal) = 32)
) STRICT;

-- As log_nodes, of the other logs.
CREATE TABLE origin_nodes (
  origin INTEGER NOT NULL,
  level  INTEGER NOT NULL CHECK (level BETWEEN 1 AND 7),
  node   INTEGER NOT NULL,
  hash   BLOB NOT NULL CHECK (length(hash) = 32),
  PRIMARY KEY (origin, level, node)
) STRICT, WITHOUT ROWID;

-- Signed heads that contradict the one above: the folder was copied and started twice.
CREATE TABLE origin_forks (
  number     INTEGER PRIMARY KEY,
  origin     INTEGER NOT NULL REFERENCES origins (number),
  checkpoint TEXT NOT NULL UNIQUE,
  created_at INTEGER NOT NULL,
  seal       BLOB CHECK (length(seal) = 32)
) STRICT;

-- Table revisions that judged such records and that this folder does not have. Rows name them by the
-- negative number.
CREATE TABLE origin_revisions (
  number INTEGER PRIMARY KEY CHECK (number > 0),
  id     TEXT NOT NULL UNIQUE,
  seal   BLOB CHECK (length(seal) = 32)
) STRICT;

-- What the centre that this folder forwards to has confirmed.
CREATE TABLE forwarding (
  id     INTEGER PRIMARY KEY CHECK (id = 1),
  centre TEXT NOT NULL,
  size   INTEGER NOT NULL,
  seal   BLOB CHECK (length(seal) = 32)
) STRICT;

-- The newest measurement there was when the answer was kept: the answer is forwarded with it.
ALTER TABLE idempotent_answers ADD COLUMN measurement INTEGER;
UPDATE idempotent_answers SET seal = NULL;
CREATE INDEX idempotent_answer_measurements ON idempotent_answers (measurement)
  WHERE measurement IS NOT NULL;

PRAGMA writable_schema = ON;
UPDATE sqlite_schema SET sql = replace(sql,
    'CHECK (role BETWEEN 1 AND 3),  -- viewer, operator, admin',
    'CHECK (role BETWEEN 1 AND 4),  -- viewer, operator, admin, station')
  WHERE type = 'table' AND name = 'api_keys';
PRAGMA writable_schema = RESET;

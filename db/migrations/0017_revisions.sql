-- What a centre hands on to its stations, in the order of its changes: which table, key, setup, plan or correction of a
-- station's record it is. What it is now stands where it is kept.

CREATE TABLE revisions (
  number  INTEGER PRIMARY KEY AUTOINCREMENT,
  tag     BLOB NOT NULL CHECK (length(tag) = 8),  -- random: after an older copy was put back a number is given again
  kind    INTEGER NOT NULL CHECK (kind BETWEEN 1 AND 5),  -- db/store/revisions_store.hpp
  name    TEXT NOT NULL,
  station INTEGER  -- of origins; NULL: for all of them
) STRICT;
CREATE INDEX revision_names ON revisions (kind, name, number);

CREATE TRIGGER table_revisions_are_handed_on AFTER INSERT ON table_revisions WHEN NEW.parent IS NOT NULL
BEGIN INSERT INTO revisions (tag, kind, name) VALUES (randomblob(8), 1, ''); END;

-- Those of viewers and operators: administrators and stations have theirs at one place.
CREATE TRIGGER api_keys_are_handed_on AFTER INSERT ON api_keys WHEN NEW.role IN (1, 2)
BEGIN INSERT INTO revisions (tag, kind, name) VALUES (randomblob(8), 2, NEW.name); END;
CREATE TRIGGER revoked_api_keys_are_handed_on AFTER UPDATE OF revoked_at ON api_keys WHEN NEW.role IN (1, 2)
BEGIN INSERT INTO revisions (tag, kind, name) VALUES (randomblob(8), 2, NEW.name); END;

CREATE TRIGGER documents_are_handed_on AFTER INSERT ON documents WHEN NEW.kind IN (3, 4)
BEGIN INSERT INTO revisions (tag, kind, name) VALUES (randomblob(8), NEW.kind, NEW.name); END;
CREATE TRIGGER deleted_documents_are_handed_on AFTER DELETE ON documents WHEN OLD.kind IN (3, 4)
BEGIN INSERT INTO revisions (tag, kind, name) VALUES (randomblob(8), OLD.kind, OLD.name); END;

INSERT INTO revisions (tag, kind, name)
  SELECT randomblob(8), 1, '' FROM table_revisions WHERE parent IS NOT NULL LIMIT 1;
INSERT INTO revisions (tag, kind, name)
  SELECT randomblob(8), 2, name FROM api_keys WHERE role IN (1, 2) GROUP BY name;
INSERT INTO revisions (tag, kind, name) SELECT randomblob(8), kind, name FROM documents WHERE kind IN (3, 4);
INSERT INTO revisions (tag, kind, name, station)
  SELECT randomblob(8), 5, id, corrected_origin FROM measurements
  WHERE correction_of IS NOT NULL AND corrected_origin > 0 AND coalesce(origin, 0) = 0;

-- What this folder has of its centre.
CREATE TABLE received (
  kind   INTEGER NOT NULL,  -- as above
  name   TEXT NOT NULL,
  number INTEGER NOT NULL,  -- of the revision there
  digest BLOB NOT NULL CHECK (length(digest) = 32),  -- what it was here then: another is of this folder
  seal   BLOB CHECK (length(seal) = 32),
  PRIMARY KEY (kind, name)
) STRICT;

-- What a centre calls the revisions of the tables that came from it: records name them so.
CREATE TABLE table_revision_ids (
  revision INTEGER PRIMARY KEY REFERENCES table_revisions (number),
  id       TEXT NOT NULL,
  seal     BLOB CHECK (length(seal) = 32)
) STRICT;

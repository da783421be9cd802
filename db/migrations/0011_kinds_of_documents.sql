-- Setups and plans are documents as well: one table for whatever is kept as a text under a name.
-- A row that does not fit its seal keeps that seal, so that it is still found.

ALTER TABLE documents RENAME TO documents_of_two_kinds;
CREATE TABLE documents (
  kind        INTEGER NOT NULL CHECK (kind BETWEEN 1 AND 4),  -- db/store/documents_store.hpp
  name        TEXT NOT NULL CHECK (name <> ''),
  text        TEXT NOT NULL,
  modified_at INTEGER NOT NULL,
  caller      TEXT,
  seal        BLOB NOT NULL CHECK (length(seal) = 32),  -- db/sqlite/row_digest.hpp
  PRIMARY KEY (kind, name)
) STRICT;
INSERT INTO documents SELECT * FROM documents_of_two_kinds;
DROP TABLE documents_of_two_kinds;

INSERT INTO documents
SELECT 3, name, text, modified_at, caller,
       iif(coalesce(seal = row_digest(name, text, modified_at, caller), 1),
           row_digest(3, name, text, modified_at, caller), seal)
FROM setups;
DROP TABLE setups;

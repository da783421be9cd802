-- What a quality engineer keeps under a name: uncertainty budgets, gauges in use.

CREATE TABLE documents (
  kind        INTEGER NOT NULL CHECK (kind BETWEEN 1 AND 2),  -- db/store/documents_store.hpp
  name        TEXT NOT NULL CHECK (name <> ''),
  text        TEXT NOT NULL,
  modified_at INTEGER NOT NULL,
  caller      TEXT,
  seal        BLOB NOT NULL CHECK (length(seal) = 32),  -- db/sqlite/row_digest.hpp
  PRIMARY KEY (kind, name)
) STRICT;

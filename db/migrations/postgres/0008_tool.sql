-- What the columns mean stands in the migration of this number beside this folder.

ALTER TABLE measurements
  ADD COLUMN tool      TEXT,
  ADD COLUMN confirmed BIGINT CHECK (confirmed = 1);

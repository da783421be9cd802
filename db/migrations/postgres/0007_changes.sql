-- What the table means stands in the migration of this number beside this folder.

CREATE TABLE changes (
  id          BIGINT PRIMARY KEY,
  at          BIGINT NOT NULL,
  caller      TEXT,
  kind        TEXT NOT NULL,
  name        TEXT NOT NULL,
  action      TEXT NOT NULL,
  before_text TEXT,
  after_text  TEXT,
  leaf        BYTEA NOT NULL CHECK (length(leaf) = 32)
);
CREATE INDEX changes_by_name ON changes (kind, name, id);
CREATE FUNCTION refuse_change_of_change() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN RAISE EXCEPTION 'a change is never altered or deleted'; END $$;
CREATE TRIGGER changes_are_kept BEFORE UPDATE OR DELETE ON changes
  FOR EACH ROW EXECUTE FUNCTION refuse_change_of_change();
CREATE TRIGGER changes_are_not_truncated BEFORE TRUNCATE ON changes
  FOR EACH STATEMENT EXECUTE FUNCTION refuse_change_of_change();

-- What the table means stands in the migration of this number beside this folder.

CREATE TABLE note_origins (
  note   BIGINT PRIMARY KEY REFERENCES notes (id),
  origin BIGINT NOT NULL REFERENCES origins (number),
  number BIGINT NOT NULL CHECK (number > 0),
  UNIQUE (origin, number)
);
CREATE TRIGGER note_origins_are_kept BEFORE UPDATE OR DELETE ON note_origins
  FOR EACH ROW EXECUTE FUNCTION refuse_change_of_note();
CREATE TRIGGER note_origins_are_not_truncated BEFORE TRUNCATE ON note_origins
  FOR EACH STATEMENT EXECUTE FUNCTION refuse_change_of_note();

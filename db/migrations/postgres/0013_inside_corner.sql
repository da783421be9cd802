-- What the column means stands in the migration of this number beside this folder.

ALTER TABLE measurements ADD COLUMN inside_corner BIGINT CHECK (inside_corner = 1);

-- What the column means stands in the migration of this number beside this folder.

ALTER TABLE measurements ADD COLUMN offset_nm BIGINT;

-- What the column means stands in the migration of this number beside this folder.

ALTER TABLE measurements ADD COLUMN gauge_blocked BIGINT CHECK (gauge_blocked = 1);

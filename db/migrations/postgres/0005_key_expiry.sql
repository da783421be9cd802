-- What the column means stands in the migration of this number beside this folder.

ALTER TABLE api_keys ADD COLUMN expires_at BIGINT;

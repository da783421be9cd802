-- When a key ends by itself; NULL: never. A seal that fits is made anew with the column, any other goes on to differ.

ALTER TABLE api_keys ADD COLUMN expires_at INTEGER;
UPDATE api_keys SET seal = row_digest(name, role, token_hash, created_at, revoked_at, expires_at)
  WHERE seal IS row_digest(name, role, token_hash, created_at, revoked_at);

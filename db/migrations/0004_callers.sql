-- API keys, and the answers kept for requests with an Idempotency-Key.

CREATE TABLE api_keys (
  id         INTEGER PRIMARY KEY,
  name       TEXT NOT NULL CHECK (name <> ''),
  role       INTEGER NOT NULL CHECK (role BETWEEN 1 AND 3),  -- viewer, operator, admin
  token_hash BLOB NOT NULL CHECK (length(token_hash) = 32),
  created_at INTEGER NOT NULL,
  revoked_at INTEGER
) STRICT;
CREATE UNIQUE INDEX api_key_names ON api_keys (name) WHERE revoked_at IS NULL;
CREATE UNIQUE INDEX api_key_tokens ON api_keys (token_hash);

CREATE TABLE idempotent_answers (
  id           INTEGER PRIMARY KEY,
  caller       TEXT NOT NULL,
  method       TEXT NOT NULL,
  path         TEXT NOT NULL,
  key          TEXT NOT NULL CHECK (key <> ''),
  body_digest  BLOB NOT NULL CHECK (length(body_digest) = 32),
  status       INTEGER NOT NULL CHECK (status BETWEEN 200 AND 299),
  content_type TEXT NOT NULL,
  location     TEXT NOT NULL,
  body         BLOB NOT NULL,
  expires_at   INTEGER NOT NULL,
  UNIQUE (key, caller, method, path)
) STRICT;
CREATE INDEX idempotent_answer_expiry ON idempotent_answers (expires_at);

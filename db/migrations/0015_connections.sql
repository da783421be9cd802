-- Connections to the world outside, and how far each has come, are documents as well.

-- Constraints of a table change only in its text: https://sqlite.org/lang_altertable.html, section 8.
PRAGMA writable_schema = ON;
UPDATE sqlite_schema SET sql = replace(sql, 'CHECK (kind BETWEEN 1 AND 4)', 'CHECK (kind BETWEEN 1 AND 6)')
  WHERE type = 'table' AND name = 'documents';
PRAGMA writable_schema = RESET;

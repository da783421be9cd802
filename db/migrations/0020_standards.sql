-- Basis 4: the designation of another standard than ISO 286 (tables/standards). The edition it was judged by is
-- a revision of its own, which origin_revisions numbers.
-- Constraints of a table change only in its text: https://sqlite.org/lang_altertable.html, section 8.
PRAGMA writable_schema = ON;
UPDATE sqlite_schema SET sql = replace(sql,
    'CHECK (basis BETWEEN 1 AND 3),  -- iso286, custom, explicit',
    'CHECK (basis BETWEEN 1 AND 4),  -- iso286, custom, explicit, standard')
  WHERE type = 'table' AND name = 'measurements';
PRAGMA writable_schema = RESET;

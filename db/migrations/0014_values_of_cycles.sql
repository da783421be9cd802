-- A cycle measures coordinates and deviations too, on a real control as in a simulation: those have any sign.

-- Constraints of a table change only in its text: https://sqlite.org/lang_altertable.html, section 8.
PRAGMA writable_schema = ON;
UPDATE sqlite_schema SET sql = replace(sql, 'CHECK (source = 2 OR measured_nm > 0)',
                                            'CHECK (cycle IS NOT NULL OR measured_nm > 0)')
  WHERE type = 'table' AND name = 'measurements';
PRAGMA writable_schema = RESET;

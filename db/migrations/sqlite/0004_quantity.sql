-- What was measured and how: NULL in the rows before. Codes of db/store/measurement_row.hpp; degrees of freedom, angle and
-- factor in 1e-6.
PRAGMA ignore_check_constraints = ON;  -- else a column that is added holds all rows to the constraints of the table
ALTER TABLE measurements ADD COLUMN quantity INTEGER;
ALTER TABLE measurements ADD COLUMN degrees_of_freedom INTEGER;
ALTER TABLE measurements ADD COLUMN size_operator TEXT;
ALTER TABLE measurements ADD COLUMN envelope TEXT;
ALTER TABLE measurements ADD COLUMN go_gauge TEXT;
ALTER TABLE measurements ADD COLUMN points INTEGER;
ALTER TABLE measurements ADD COLUMN start_angle INTEGER;
ALTER TABLE measurements ADD COLUMN diameter_factor INTEGER;
-- A position (4), a distance (5) and a deviation (8) may lie below 0. The constraint is widened where it is written: no row
-- is touched (https://sqlite.org/lang_altertable.html, section 7). The last column makes SQLite read it again.
PRAGMA writable_schema = ON;
UPDATE sqlite_schema
   SET sql = replace(sql, 'CHECK (cycle IS NOT NULL OR measured_nm > 0)',
                     'CHECK (cycle IS NOT NULL OR measured_nm > 0 OR coalesce(quantity, 0) IN (4, 5, 8))')
 WHERE type = 'table' AND name = 'measurements';
PRAGMA writable_schema = OFF;
ALTER TABLE measurements ADD COLUMN form_nm INTEGER;
PRAGMA ignore_check_constraints = OFF;

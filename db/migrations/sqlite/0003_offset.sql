-- The correction that was made before the part was made, as its caller gave it, in nm; NULL in the rows before.

PRAGMA ignore_check_constraints = ON;  -- else a column that is added holds all rows to the constraints of the table
ALTER TABLE measurements ADD COLUMN offset_nm INTEGER;
PRAGMA ignore_check_constraints = OFF;

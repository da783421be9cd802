-- 1 where a radius or chamfer is that of an inside corner; NULL in the rows before.

PRAGMA ignore_check_constraints = ON;  -- else a column that is added holds all rows to the constraints of the table
ALTER TABLE measurements ADD COLUMN inside_corner INTEGER CHECK (inside_corner = 1);
PRAGMA ignore_check_constraints = OFF;

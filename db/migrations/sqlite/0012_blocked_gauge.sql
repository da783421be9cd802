-- 1 where the gauge was blocked when it measured; NULL in the rows before.

PRAGMA ignore_check_constraints = ON;  -- else a column that is added holds all rows to the constraints of the table
ALTER TABLE measurements ADD COLUMN gauge_blocked INTEGER CHECK (gauge_blocked = 1);
PRAGMA ignore_check_constraints = OFF;

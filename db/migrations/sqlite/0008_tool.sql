-- What cut the part, and 1 where a person confirmed a value that was called far outside; NULL in the rows before.

PRAGMA ignore_check_constraints = ON;  -- else a column that is added holds all rows to the constraints of the table
ALTER TABLE measurements ADD COLUMN tool TEXT;
ALTER TABLE measurements ADD COLUMN confirmed INTEGER CHECK (confirmed = 1);
PRAGMA ignore_check_constraints = OFF;

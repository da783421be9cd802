-- The certificate's number and the laboratory of the gauge's calibration in date; NULL in the rows before.

PRAGMA ignore_check_constraints = ON;  -- else a column that is added holds all rows to the constraints of the table
ALTER TABLE measurements ADD COLUMN calibration_certificate TEXT;
ALTER TABLE measurements ADD COLUMN calibration_laboratory TEXT;
PRAGMA ignore_check_constraints = OFF;

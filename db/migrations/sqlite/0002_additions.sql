-- What the correction to 20 degrees adds to the uncertainty of a size, and what that was computed from: standard
-- uncertainties, NULL in the rows before.

PRAGMA ignore_check_constraints = ON;  -- else each column that is added holds all rows to the constraints of the table
ALTER TABLE measurements ADD COLUMN temperature_uncertainty INTEGER CHECK (temperature_uncertainty >= 0);  -- in 1e-6
ALTER TABLE measurements ADD COLUMN scale_temperature_uncertainty INTEGER CHECK (scale_temperature_uncertainty >= 0);
ALTER TABLE measurements ADD COLUMN part_expansion_uncertainty INTEGER CHECK (part_expansion_uncertainty >= 0);
ALTER TABLE measurements ADD COLUMN scale_expansion_uncertainty INTEGER CHECK (scale_expansion_uncertainty >= 0);
ALTER TABLE measurements ADD COLUMN added_uncertainty INTEGER  -- in pm
  CHECK (added_uncertainty IS NULL OR (added_uncertainty >= 0 AND corrected_nm IS NOT NULL));
PRAGMA ignore_check_constraints = OFF;

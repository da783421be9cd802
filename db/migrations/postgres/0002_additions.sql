-- What the columns mean stands in the migration of this number beside this folder. NOT VALID: the rows before have
-- nothing in them, which need not be read.

ALTER TABLE measurements
  ADD COLUMN temperature_uncertainty       BIGINT,
  ADD COLUMN scale_temperature_uncertainty BIGINT,
  ADD COLUMN part_expansion_uncertainty    BIGINT,
  ADD COLUMN scale_expansion_uncertainty   BIGINT,
  ADD COLUMN added_uncertainty             BIGINT,
  ADD CONSTRAINT thermal_uncertainties CHECK (
    least(temperature_uncertainty, scale_temperature_uncertainty, part_expansion_uncertainty,
          scale_expansion_uncertainty, added_uncertainty) >= 0
    AND (added_uncertainty IS NULL OR corrected_nm IS NOT NULL)) NOT VALID;

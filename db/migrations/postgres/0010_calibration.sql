-- What the columns mean stands in the migration of this number beside this folder.

ALTER TABLE measurements
  ADD COLUMN calibration_certificate TEXT,
  ADD COLUMN calibration_laboratory  TEXT;

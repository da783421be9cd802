-- What the columns mean stands in the migration of this number beside this folder.

ALTER TABLE measurements
  ADD COLUMN quantity           SMALLINT,
  ADD COLUMN degrees_of_freedom BIGINT,
  ADD COLUMN size_operator      TEXT,
  ADD COLUMN envelope           TEXT,
  ADD COLUMN go_gauge           TEXT,
  ADD COLUMN points             BIGINT,
  ADD COLUMN start_angle        BIGINT,
  ADD COLUMN diameter_factor    BIGINT,
  ADD COLUMN form_nm            BIGINT;

-- A position (4), a distance (5) and a deviation (8) may lie below 0.
DO $$
DECLARE
  narrow TEXT;
BEGIN
  FOR narrow IN
    SELECT conname FROM pg_constraint
     WHERE conrelid = 'measurements'::regclass AND contype = 'c'
       AND pg_get_constraintdef(oid) LIKE '%cycle IS NOT NULL%measured_nm%'
  LOOP
    EXECUTE format('ALTER TABLE measurements DROP CONSTRAINT %I', narrow);
  END LOOP;
END $$;
ALTER TABLE measurements ADD CONSTRAINT measurements_size
  CHECK (cycle IS NOT NULL OR measured_nm > 0 OR coalesce(quantity, 0) IN (4, 5, 8)) NOT VALID;

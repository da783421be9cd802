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

ALTER TABLE measurement_nodes ADD COLUMN paired BIGINT NOT NULL DEFAULT 0;
CREATE INDEX unpaired_measurement_nodes ON measurement_nodes (level, node) WHERE paired = 0;
-- A daemon of an earlier release that still runs mends the aggregates alone.
CREATE FUNCTION unpair_stale_node() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN NEW.paired := 0; RETURN NEW; END $$;
CREATE TRIGGER stale_nodes_are_unpaired BEFORE UPDATE OF stale ON measurement_nodes
FOR EACH ROW WHEN (NEW.stale = 1) EXECUTE FUNCTION unpair_stale_node();
CREATE TABLE measurement_columns (
  block BIGINT PRIMARY KEY,
  bytes BYTEA NOT NULL
);
CREATE TABLE measurement_pairs (
  level    BIGINT NOT NULL,
  field    BIGINT NOT NULL,
  by_field BIGINT NOT NULL,
  node     BIGINT NOT NULL,
  bytes    BYTEA NOT NULL,
  PRIMARY KEY (level, field, by_field, node)
);

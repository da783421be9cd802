-- The rational subgroup of a control chart that a measurement belongs to.
ALTER TABLE measurements ADD COLUMN subgroup TEXT;

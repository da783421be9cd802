-- Why stands in the migration of this number beside this folder.

UPDATE measurement_nodes SET stale = 1, paired = 0 WHERE (level, node) IN (
  SELECT l.level, (m.id - 1) >> (10 + 5 * l.level)::int
    FROM measurements m CROSS JOIN (SELECT DISTINCT level FROM measurement_nodes) l
    WHERE m.corrected_nm IS NOT NULL);

-- Summaries are of the size at 20 degrees: what was summed up of rows with one is stale, and made anew by the
-- writer's maintenance.

UPDATE measurement_nodes SET stale = 1, paired = 0 WHERE (level, node) IN (
  SELECT l.level, (m.id - 1) >> (10 + 5 * l.level)
    FROM measurements m CROSS JOIN (SELECT DISTINCT level FROM measurement_nodes) l
    WHERE m.corrected_nm IS NOT NULL);

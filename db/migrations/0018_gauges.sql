-- What the gauge in use said when the value was judged: the budget its uncertainty is of, and since when its calibration
-- was overdue.

ALTER TABLE measurements ADD COLUMN uncertainty_budget TEXT CHECK (uncertainty_budget IS NULL OR uncertainty_nm IS NOT NULL);
ALTER TABLE measurements ADD COLUMN calibration_due TEXT;

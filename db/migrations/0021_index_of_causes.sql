-- The records whose notes name a cause, found without a look at each record.
CREATE INDEX notes_of_causes ON notes (cause, measurement) WHERE cause IS NOT NULL;

; run: failed line 4: Feed rate is missing: a feed of 0 mm/min
BEGIN PGM BAD MM
TOOL CALL 30 Z
L X+10
END PGM BAD MM

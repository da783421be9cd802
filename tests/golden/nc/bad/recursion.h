; run: failed line 4: Excessive nesting: more than 19 subprograms call each other
BEGIN PGM BAD MM
LBL 1
CALL LBL 1
LBL 0
END PGM BAD MM

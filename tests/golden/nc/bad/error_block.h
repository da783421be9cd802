; run: failed line 3: block is faulty: 13 TOOL CALL X
BEGIN PGM BAD MM
13 ERROR = 13 TOOL CALL X
END PGM BAD MM

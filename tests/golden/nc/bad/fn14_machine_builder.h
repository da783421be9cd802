; run: failed line 3: FN 14: Error code 42
BEGIN PGM BAD MM
FN 14: ERROR = 42
END PGM BAD MM

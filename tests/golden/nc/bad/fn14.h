; run: failed line 3: Position error: center in axis 1
BEGIN PGM BAD MM
FN 14: ERROR = 1044
END PGM BAD MM

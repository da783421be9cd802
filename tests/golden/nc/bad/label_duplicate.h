; diagnostic: label.duplicate line 4
BEGIN PGM BAD MM
LBL "A"
LBL "a"
END PGM BAD MM

; diagnostic: label.unknown line 3
BEGIN PGM BAD MM
CALL LBL 0
END PGM BAD MM

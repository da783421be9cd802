; diagnostic: label.repeat_before line 3
BEGIN PGM BAD MM
CALL LBL 1 REP 2
LBL 1
END PGM BAD MM

; diagnostic: label.unknown line 4
BEGIN PGM BAD MM
Q1 = 1
FN 9: IF +Q1 EQU +1 GOTO LBL 5
END PGM BAD MM

; run: limit_exceeded line 4: the run has executed its limit of 1000000 blocks
BEGIN PGM BAD MM
LBL 1
FN 9: IF +1 EQU +1 GOTO LBL 1
END PGM BAD MM

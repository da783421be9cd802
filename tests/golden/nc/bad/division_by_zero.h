; run: failed line 4: division by zero (1 / 0)
BEGIN PGM BAD MM
Q1 = 0
FN 4: Q2 = +1 DIV +Q1
END PGM BAD MM

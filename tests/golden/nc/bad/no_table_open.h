; run: failed line 3: no table is open: FN 26: TABOPEN stands before this
BEGIN PGM BAD MM
FN 28: TABREAD Q10 = 0/"X"
END PGM BAD MM

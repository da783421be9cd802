; run: failed line 3: no table is open: write FN 26: TABOPEN before this block
BEGIN PGM BAD MM
FN 28: TABREAD Q10 = 0/"X"
END PGM BAD MM

; run: failed line 3: table TNC:\nc_prog\none.tab does not exist
BEGIN PGM BAD MM
FN 26: TABOPEN none.tab
END PGM BAD MM

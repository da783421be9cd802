; run: failed line 3: mask TNC:\nc_prog\none.a does not exist
BEGIN PGM BAD MM
FN 16: F-PRINT none.a / SCREEN:
END PGM BAD MM

; run: failed line 3: M51 is not available
BEGIN PGM BAD MM
L X+0 FMAX M51
END PGM BAD MM

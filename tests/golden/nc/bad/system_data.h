; run: failed line 3: ID4711 NR1 is not available
BEGIN PGM BAD MM
FN 18: SYSREAD Q1 = ID4711 NR1
END PGM BAD MM

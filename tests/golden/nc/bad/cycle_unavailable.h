; run: failed line 3: cycle TCH PROBE 586 is not available
BEGIN PGM BAD MM
TCH PROBE 586 MEASURE ~
    Q263=+1
END PGM BAD MM

; run: failed line 3: path '..\..\..\etc\passwd' leaves TNC:\; only files below it can be used
BEGIN PGM BAD MM
CALL PGM ..\..\..\etc\passwd
END PGM BAD MM

; run: failed line 3: TCH PROBE 586 is not available here; if the builder of the machine made it, say in the setup what it does: "cycles":{"586":"ignore"}, or {"call":"TNC:\\oem\\586.h"}
BEGIN PGM BAD MM
TCH PROBE 586 MEASURE ~
    Q263=+1
END PGM BAD MM

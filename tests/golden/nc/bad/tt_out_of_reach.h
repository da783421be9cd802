; run: failed line 5: Touch point inaccessible: tool 5 does not reach the tool touch probe within 50 mm
BEGIN PGM BAD MM
TOOL DEF 5 L+100 R+6
TOOL CALL 5 Z
TCH PROBE 484 CALIBRATE IR TT ~
    Q536=+1
END PGM BAD MM

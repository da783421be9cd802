; run: failed line 4: Touch point inaccessible: nothing within DIST = 20 mm of the start
BEGIN PGM BAD MM
TOOL CALL 30 Z
TCH PROBE 461 TS CALIBRATION OF TOOL LENGTH ~
    Q434=+0
END PGM BAD MM

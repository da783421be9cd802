; run: failed line 6: Scaling factors not equal: reset cycle 26 before measuring
BEGIN PGM BAD MM
TOOL CALL 30 Z
CYCL DEF 26.0 AXIS-SPEC. SCALING
CYCL DEF 26.1 X1.1 Y1 CCX+0 CCY+0
TCH PROBE 421 MEASURE HOLE ~
    Q273=+50 ~
    Q274=+65 ~
    Q262=+12 ~
    Q247=+90 ~
    Q261=-5 ~
    Q260=+20 ~
    Q275=+12.045 ~
    Q276=+12
END PGM BAD MM

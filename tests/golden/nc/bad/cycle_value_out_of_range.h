; run: failed line 5: Range exceeded: Q247 = 121 is not in -120 to 120
BEGIN PGM BAD MM
TOOL CALL 30 Z
Q1 = 121
TCH PROBE 421 MEASURE HOLE ~
    Q273=+50 ~
    Q274=+65 ~
    Q262=+12 ~
    Q247=Q1 ~
    Q261=-5 ~
    Q260=+20 ~
    Q275=+12.045 ~
    Q276=+12
END PGM BAD MM

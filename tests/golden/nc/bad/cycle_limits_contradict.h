; run: failed line 4: Contradictory input: maximum Q275 = 11.9 is less than minimum Q276 = 12
BEGIN PGM BAD MM
TOOL CALL 30 Z
TCH PROBE 421 MEASURE HOLE ~
    Q273=+50 ~
    Q274=+65 ~
    Q262=+12 ~
    Q247=+90 ~
    Q261=-5 ~
    Q260=+20 ~
    Q275=+11.9 ~
    Q276=+12
END PGM BAD MM

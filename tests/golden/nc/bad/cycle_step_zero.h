; run: failed line 4: Enter Q247 unequal to 0
BEGIN PGM BAD MM
TOOL CALL 30 Z
TCH PROBE 421 MEASURE HOLE ~
    Q273=+50 ~
    Q274=+65 ~
    Q262=+12 ~
    Q247=+0 ~
    Q261=-5 ~
    Q260=+20 ~
    Q275=+12.045 ~
    Q276=+12
END PGM BAD MM

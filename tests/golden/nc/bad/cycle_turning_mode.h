; run: failed line 5: Function not permitted: touch-probe cycles need FUNCTION MODE MILL
BEGIN PGM BAD MM
TOOL CALL 30 Z
FUNCTION MODE TURN
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

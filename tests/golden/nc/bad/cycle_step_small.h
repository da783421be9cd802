; run: failed line 5: Enter Q247 greater than 5
BEGIN PGM BAD MM
TOOL CALL 30 Z
Q1 = 4.5
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

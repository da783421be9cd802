; run: failed line 3: Tool axis is missing
BEGIN PGM BAD MM
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

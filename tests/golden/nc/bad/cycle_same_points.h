; run: failed line 4: Contradictory meas. points: both points lie at the same place of the line
BEGIN PGM BAD MM
TOOL CALL 30 Z
TCH PROBE 400 BASIC ROTATION ~
    Q263=+110 ~
    Q264=+0 ~
    Q265=+110 ~
    Q266=+0 ~
    Q272=+2 ~
    Q267=+1 ~
    Q261=-5 ~
    Q320=+2 ~
    Q260=+30 ~
    Q301=+0 ~
    Q305=+0
END PGM BAD MM

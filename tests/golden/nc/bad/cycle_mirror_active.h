; run: failed line 6: MIRROR IMAGE not permitted: reset cycle 8 before this cycle
BEGIN PGM BAD MM
TOOL CALL 30 Z
CYCL DEF 8.0 MIRROR IMAGE
CYCL DEF 8.1 X
TCH PROBE 400 BASIC ROTATION ~
    Q263=+110 ~
    Q264=+0 ~
    Q265=+190 ~
    Q266=+0 ~
    Q272=+2 ~
    Q267=+1 ~
    Q261=-5 ~
    Q320=+2 ~
    Q260=+30 ~
    Q301=+0 ~
    Q305=+0
END PGM BAD MM

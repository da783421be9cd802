; run: failed line 4: Wrong axis programmed: Q312 is 0, 4 (A), 5 (B) or 6 (C)
BEGIN PGM BAD MM
TOOL CALL 30 Z
TCH PROBE 403 ROT IN ROTARY AXIS ~
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
    Q312=+2 ~
    Q305=+0
END PGM BAD MM

; run: failed line 4: Traverse direction not defined: Q267 must be -1 or +1
BEGIN PGM BAD MM
TOOL CALL 30 Z
TCH PROBE 419 DATUM IN ONE AXIS ~
    Q263=+0 ~
    Q264=+80 ~
    Q261=-5 ~
    Q260=+30 ~
    Q272=+1 ~
    Q267=+0 ~
    Q305=+9
END PGM BAD MM

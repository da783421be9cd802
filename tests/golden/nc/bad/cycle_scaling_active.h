; run: failed line 6: SCALING FACTOR not permitted: reset cycles 11 and 26 before this cycle
BEGIN PGM BAD MM
TOOL CALL 30 Z
CYCL DEF 11.0 SCALING
CYCL DEF 11.1 SCL0.5
TCH PROBE 417 DATUM IN TS AXIS ~
    Q263=+0 ~
    Q264=+80 ~
    Q294=-5 ~
    Q260=+30 ~
    Q305=+9 ~
    Q303=+1
END PGM BAD MM

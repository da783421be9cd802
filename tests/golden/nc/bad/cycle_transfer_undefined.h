; run: failed line 4: Q303 in meas. cycle undefined!: 0 is the datum table, 1 the preset table
BEGIN PGM BAD MM
TOOL CALL 30 Z
TCH PROBE 417 DATUM IN TS AXIS ~
    Q263=+0 ~
    Q264=+80 ~
    Q294=-5 ~
    Q260=+30 ~
    Q305=+9 ~
    Q303=-1
END PGM BAD MM

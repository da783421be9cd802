; run: failed line 4: Touch point inaccessible: nothing within DIST = 20 mm of the start
BEGIN PGM BAD MM
TOOL CALL 30 Z
TCH PROBE 427 MEASURE COORDINATE ~
    Q263=+50 ~
    Q264=+40 ~
    Q261=+0 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20
END PGM BAD MM

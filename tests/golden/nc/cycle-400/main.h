BEGIN PGM ROTATION MM
; An edge along the main axis becomes the basic rotation.
TOOL CALL 30 Z
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
    Q307=+0 ~
    Q305=+0
FN 18: SYSREAD Q1601 = ID210 NR1
; against a reference line of 1.5 degrees
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
    Q307=+1.5 ~
    Q305=+0
FN 18: SYSREAD Q1602 = ID210 NR1
; measuring resets it
TCH PROBE 420 MEASURE ANGLE ~
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
    Q281=+0
FN 18: SYSREAD Q1603 = ID210 NR1
END PGM ROTATION MM

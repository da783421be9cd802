%ROTATION G71 *
; An edge along the main axis becomes the basic rotation.
N10 T30 G17 *
N20 G400 BASIC ROTATION ~
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
    Q305=+0 *
N30 D18: SYSREAD Q1601 = ID210 NR1 *
; against a reference line of 1.5 degrees
N40 G400 BASIC ROTATION ~
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
    Q305=+0 *
N50 D18: SYSREAD Q1602 = ID210 NR1 *
; measuring resets it
N60 G420 MEASURE ANGLE ~
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
    Q281=+0 *
N70 D18: SYSREAD Q1603 = ID210 NR1 *
N99999999 %ROTATION G71 *

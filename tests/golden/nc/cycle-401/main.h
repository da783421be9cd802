BEGIN PGM TWOHOLES MM
; The line between two holes becomes the basic rotation.
TOOL CALL 30 Z
TCH PROBE 401 ROT OF 2 HOLES ~
    Q268=+20 ~
    Q269=+20 ~
    Q270=+120 ~
    Q271=+20 ~
    Q261=-5 ~
    Q260=+30 ~
    Q307=+0 ~
    Q305=+0 ~
    Q402=+0 ~
    Q337=+0
FN 18: SYSREAD Q1601 = ID210 NR1
END PGM TWOHOLES MM

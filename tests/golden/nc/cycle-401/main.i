%TWOHOLES G71 *
; The line between two holes becomes the basic rotation.
N10 T30 G17 *
N20 G401 ROT OF 2 HOLES ~
    Q268=+20 ~
    Q269=+20 ~
    Q270=+120 ~
    Q271=+20 ~
    Q261=-5 ~
    Q260=+30 ~
    Q307=+0 ~
    Q305=+0 ~
    Q402=+0 ~
    Q337=+0 *
N30 D18: SYSREAD Q1601 = ID210 NR1 *
N99999999 %TWOHOLES G71 *

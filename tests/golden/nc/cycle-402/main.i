%TWOSTUDS G71 *
; The line between two studs becomes the basic rotation.
N10 T30 G17 *
N20 G402 ROT OF 2 STUDS ~
    Q268=+20 ~
    Q269=+20 ~
    Q313=+10 ~
    Q261=+5 ~
    Q270=+120 ~
    Q271=+20 ~
    Q314=+12 ~
    Q315=+5 ~
    Q320=+3 ~
    Q260=+30 ~
    Q301=+1 ~
    Q307=+0 ~
    Q305=+0 ~
    Q402=+0 ~
    Q337=+0 *
N30 D18: SYSREAD Q1601 = ID210 NR1 *
N99999999 %TWOSTUDS G71 *

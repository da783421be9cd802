%CORNER G71 *
; The lower left corner of a block reads X+0 Y+0.
N10 T30 G17 *
N20 G414 DATUM OUTSIDE CORNER ~
    Q263=+110 ~
    Q264=+80 ~
    Q326=+40 ~
    Q296=+100 ~
    Q297=+90 ~
    Q327=+30 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q304=+1 ~
    Q305=+9 ~
    Q331=+0 ~
    Q332=+0 ~
    Q303=+1 ~
    Q381=+0 ~
    Q382=+0 ~
    Q383=+0 ~
    Q384=+0 ~
    Q333=+0 *
N30 D18: SYSREAD Q1601 = ID503 NR9 IDX1 *
N40 D18: SYSREAD Q1602 = ID503 NR9 IDX2 *
N50 D18: SYSREAD Q1603 = ID503 NR9 IDX3 *
N99999999 %CORNER G71 *

%INNERCORNER G71 *
; The lower left corner of a pocket reads X+0 Y+0.
N10 T30 G17 *
N20 G415 DATUM INSIDE CORNER ~
    Q263=+70 ~
    Q264=+60 ~
    Q326=+30 ~
    Q327=+20 ~
    Q308=+1 ~
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
N99999999 %INNERCORNER G71 *

%STUDDATUM G71 *
; The centre of a rectangle reads X+1 Y+2.
N10 T30 G17 *
N20 G411 DATUM OUTS. RECTAN. ~
    Q321=+100 ~
    Q322=+80 ~
    Q323=+60 ~
    Q324=+40 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+1 ~
    Q305=+9 ~
    Q331=+1 ~
    Q332=+2 ~
    Q303=+1 ~
    Q381=+1 ~
    Q382=+20 ~
    Q383=+20 ~
    Q384=+0 ~
    Q333=+0 *
N30 D18: SYSREAD Q1601 = ID503 NR9 IDX1 *
N40 D18: SYSREAD Q1602 = ID503 NR9 IDX2 *
N50 D18: SYSREAD Q1603 = ID503 NR9 IDX3 *
N99999999 %STUDDATUM G71 *

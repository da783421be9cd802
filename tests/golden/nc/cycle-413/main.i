%BOSSDATUM G71 *
; The centre of a stud reads X+1 Y+2, from three touches.
N10 T30 G17 *
N20 G413 DATUM OUTSIDE CIRCLE ~
    Q321=+100 ~
    Q322=+80 ~
    Q262=+25 ~
    Q325=+0 ~
    Q247=+120 ~
    Q261=+5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q305=+9 ~
    Q331=+1 ~
    Q332=+2 ~
    Q303=+1 ~
    Q381=+1 ~
    Q382=+20 ~
    Q383=+20 ~
    Q384=+0 ~
    Q333=+0 ~
    Q423=+3 ~
    Q365=+1 *
N30 D18: SYSREAD Q1601 = ID503 NR9 IDX1 *
N40 D18: SYSREAD Q1602 = ID503 NR9 IDX2 *
N50 D18: SYSREAD Q1603 = ID503 NR9 IDX3 *
N99999999 %BOSSDATUM G71 *

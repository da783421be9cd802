%HOLEDATUM G71 *
; The centre of a hole reads X+1 Y+2: stored, then at once.
N10 T30 G17 *
N20 G412 DATUM INSIDE CIRCLE ~
    Q321=+100 ~
    Q322=+80 ~
    Q262=+25 ~
    Q325=+0 ~
    Q247=+90 ~
    Q261=-5 ~
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
    Q423=+4 ~
    Q365=+1 *
N30 D18: SYSREAD Q1601 = ID503 NR9 IDX1 *
N40 D18: SYSREAD Q1602 = ID503 NR9 IDX2 *
N50 D18: SYSREAD Q1603 = ID503 NR9 IDX3 *
; at once
N60 G412 DATUM INSIDE CIRCLE ~
    Q321=+100 ~
    Q322=+80 ~
    Q262=+25 ~
    Q325=+0 ~
    Q247=+90 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q305=+0 ~
    Q331=+1 ~
    Q332=+2 ~
    Q303=+1 ~
    Q381=+0 ~
    Q382=+20 ~
    Q383=+20 ~
    Q384=+0 ~
    Q333=+0 ~
    Q423=+4 ~
    Q365=+1 *
N70 D18: SYSREAD Q1604 = ID240 NR8 IDX1 *
N80 D18: SYSREAD Q1605 = ID270 NR1 IDX1 *
N99999999 %HOLEDATUM G71 *

%RIDGEDATUM G71 *
; The middle of a ridge reads X+10, a face beside it Z+0.
N10 T30 G17 *
N20 G409 RIDGE CENTER REF PT ~
    Q321=+100 ~
    Q322=+80 ~
    Q311=+30 ~
    Q272=+1 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q305=+9 ~
    Q405=+10 ~
    Q303=+1 ~
    Q381=+1 ~
    Q382=+20 ~
    Q383=+20 ~
    Q384=+0 ~
    Q333=+0 *
N30 D18: SYSREAD Q1601 = ID503 NR9 IDX1 *
N40 D18: SYSREAD Q1602 = ID503 NR9 IDX2 *
N50 D18: SYSREAD Q1603 = ID503 NR9 IDX3 *
N99999999 %RIDGEDATUM G71 *

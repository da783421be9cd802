BEGIN PGM BOSSDATUM MM
; The centre of a stud reads X+1 Y+2, from three touches.
TOOL CALL 30 Z
TCH PROBE 413 DATUM OUTSIDE CIRCLE ~
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
    Q365=+1
FN 18: SYSREAD Q1601 = ID503 NR9 IDX1
FN 18: SYSREAD Q1602 = ID503 NR9 IDX2
FN 18: SYSREAD Q1603 = ID503 NR9 IDX3
END PGM BOSSDATUM MM

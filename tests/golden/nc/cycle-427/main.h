BEGIN PGM FACE MM
; The coordinate of a face: good with a corrected tool, on each limit and beyond it.
TOOL CALL 30 Z
QL1 = 50 ; Q263
QL2 = 0 ; Q261
QL3 = 3 ; Q272
QL4 = 1 ; Q281
QL5 = 0.02 ; Q288
QL6 = -0.02 ; Q289
QL7 = 0 ; Q309
QL8 = 7 ; Q330
LBL 1
TCH PROBE 427 MEASURE COORDINATE ~
    Q263=+QL1 ~
    Q264=+40 ~
    Q261=+QL2 ~
    Q320=+0 ~
    Q272=+QL3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+QL4 ~
    Q288=+QL5 ~
    Q289=+QL6 ~
    Q309=+QL7 ~
    Q330=+QL8
LBL 0
Q1601 = Q180 * 100 + Q181 * 10 + Q182
FN 18: SYSREAD Q1600 = ID50 NR4 IDX7
; on the upper limit
QL4 = 0
QL5 = 0.013
QL8 = 0
CALL LBL 1
Q1602 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um above
QL5 = 0.0129
CALL LBL 1
Q1603 = Q180 * 100 + Q181 * 10 + Q182
; on the lower limit
QL5 = 0.02
QL6 = 0.013
CALL LBL 1
Q1604 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um below
QL6 = 0.0131
CALL LBL 1
Q1605 = Q180 * 100 + Q181 * 10 + Q182
; a face in the main axis
QL1 = 200
QL2 = -5
QL3 = 1
QL5 = 200.01
QL6 = 199.99
CALL LBL 1
Q1606 = Q180 * 100 + Q181 * 10 + Q182
; stops: too high
QL1 = 50
QL2 = 0
QL3 = 3
QL5 = 0.01
QL6 = -0.02
QL7 = 1
CALL LBL 1
END PGM FACE MM

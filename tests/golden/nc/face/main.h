BEGIN PGM FACE MM
; 232 over 80 x 50 in its three strategies: 3.5 to 0.5 in two infeeds and 0.5 to finish, then one infeed each.
TOOL CALL 5 Z S1000
L X+0 Y+0 Z+50 R0 FMAX M3
QL1 = 0 ; strategy
QL2 = +80 ; length
QL3 = +0.5 ; allowance
QL4 = 2 ; infeed
LBL 1
CYCL DEF 232 FACE MILLING ~
    Q389=+QL1 ~
    Q225=+10 ~
    Q226=+20 ~
    Q227=+3.5 ~
    Q386=+0 ~
    Q218=+QL2 ~
    Q219=+50 ~
    Q202=+QL4 ~
    Q369=+QL3 ~
    Q370=+1.8 ~
    Q207=+500 ~
    Q385=+800 ~
    Q253=+2000 ~
    Q200=+2 ~
    Q357=+3 ~
    Q204=+30
CYCL CALL
LBL 0
FN 18: SYSREAD Q1601 = ID270 NR1 IDX1
FN 18: SYSREAD Q1602 = ID270 NR1 IDX2
; within the edges, towards X-
QL1 = 1
QL2 = -80
QL3 = 0
QL4 = 5
CALL LBL 1
; line by line
QL1 = 2
QL2 = +80
CALL LBL 1
L Z+50 FMAX M30
END PGM FACE MM

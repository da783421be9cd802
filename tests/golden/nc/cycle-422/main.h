BEGIN PGM STUD MM
; A stud: good with a corrected tool, on each limit, beyond it, off its centre.
TOOL CALL 30 Z
QL1 = 25 ; Q277
QL2 = 24.979 ; Q278
QL3 = 0.05 ; Q280
QL4 = 1 ; Q281
QL5 = 0 ; Q309
QL6 = 7 ; Q330
LBL 1
TCH PROBE 422 MEAS. CIRCLE OUTSIDE ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+25 ~
    Q325=+10 ~
    Q247=+90 ~
    Q261=+5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q277=+QL1 ~
    Q278=+QL2 ~
    Q279=+0.05 ~
    Q280=+QL3 ~
    Q281=+QL4 ~
    Q309=+QL5 ~
    Q330=+QL6
LBL 0
Q1601 = Q180 * 100 + Q181 * 10 + Q182
FN 18: SYSREAD Q1600 = ID50 NR5 IDX7
; on the upper limit
QL1 = 24.99
QL4 = 0
QL6 = 0
CALL LBL 1
Q1602 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um above the upper limit
QL1 = 24.9899
CALL LBL 1
Q1603 = Q180 * 100 + Q181 * 10 + Q182
; on the lower limit
QL1 = 25
QL2 = 24.99
CALL LBL 1
Q1604 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um below the lower limit
QL2 = 24.9901
CALL LBL 1
Q1605 = Q180 * 100 + Q181 * 10 + Q182
; centre out of tolerance
QL2 = 24.979
QL3 = 0.0299
CALL LBL 1
Q1606 = Q180 * 100 + Q181 * 10 + Q182
; three touches over the clearance height
TCH PROBE 422 MEAS. CIRCLE OUTSIDE ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+25 ~
    Q325=+10 ~
    Q247=+120 ~
    Q261=+5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+1 ~
    Q277=+25 ~
    Q278=+24.979 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0 ~
    Q423=+3
Q1607 = Q180 * 100 + Q181 * 10 + Q182
; stops: too small
QL2 = 24.995
QL3 = 0.05
QL5 = 1
CALL LBL 1
END PGM STUD MM

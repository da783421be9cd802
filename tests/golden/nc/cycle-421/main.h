BEGIN PGM HOLE MM
; The hole of the control's own log: good, on each limit, beyond it, off its centre.
TOOL CALL 30 Z
QL1 = 0 ; Q301
QL2 = 12.045 ; Q275
QL3 = 12 ; Q276
QL4 = 0.1 ; Q279
QL5 = 1 ; Q281
QL6 = 0 ; Q309
LBL 1
TCH PROBE 421 MEASURE HOLE ~
    Q273=+50 ~
    Q274=+65 ~
    Q262=+12 ~
    Q325=+0 ~
    Q247=+90 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+20 ~
    Q301=+QL1 ~
    Q275=+QL2 ~
    Q276=+QL3 ~
    Q279=+QL4 ~
    Q280=+0.1 ~
    Q281=+QL5 ~
    Q309=+QL6 ~
    Q330=+0
LBL 0
Q1601 = Q180 * 100 + Q181 * 10 + Q182
; on the upper limit
QL2 = 12.0259
QL5 = 0
CALL LBL 1
Q1602 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um above the upper limit
QL2 = 12.0258
CALL LBL 1
Q1603 = Q180 * 100 + Q181 * 10 + Q182
; on the lower limit
QL2 = 12.045
QL3 = 12.0259
CALL LBL 1
Q1604 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um below the lower limit
QL3 = 12.026
CALL LBL 1
Q1605 = Q180 * 100 + Q181 * 10 + Q182
; centre out of tolerance
QL3 = 12
QL4 = 0.0809
CALL LBL 1
Q1606 = Q180 * 100 + Q181 * 10 + Q182
; no limits, three touches
TCH PROBE 421 MEASURE HOLE ~
    Q273=+50 ~
    Q274=+65 ~
    Q262=+12 ~
    Q325=+0 ~
    Q247=-120 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+20 ~
    Q301=+0 ~
    Q275=+0 ~
    Q276=+0 ~
    Q279=+0 ~
    Q280=+0 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0 ~
    Q423=+3
Q1607 = Q180 * 100 + Q181 * 10 + Q182
; over the clearance height
QL1 = 1
QL4 = 0.1
CALL LBL 1
Q1608 = Q180 * 100 + Q181 * 10 + Q182
; stops: too large
QL1 = 0
QL2 = 12.02
QL6 = 1
CALL LBL 1
END PGM HOLE MM

BEGIN PGM BOLTS MM
; Three holes of a bolt circle: good, on the limit, beyond it, off their centre.
TOOL CALL 30 Z
QL1 = 60.05 ; Q288
QL2 = 59.95 ; Q289
QL3 = 0.05 ; Q279
QL4 = 1 ; Q281
QL5 = 0 ; Q309
LBL 1
TCH PROBE 430 MEAS. BOLT HOLE CIRC ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+60 ~
    Q291=+0 ~
    Q292=+90 ~
    Q293=+180 ~
    Q261=-5 ~
    Q260=+20 ~
    Q288=+QL1 ~
    Q289=+QL2 ~
    Q279=+QL3 ~
    Q280=+0.05 ~
    Q281=+QL4 ~
    Q309=+QL5 ~
    Q330=+0
LBL 0
Q1601 = Q180 * 100 + Q181 * 10 + Q182
; on the upper limit
QL1 = 60.02
QL4 = 0
CALL LBL 1
Q1602 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um above
QL1 = 60.0199
CALL LBL 1
Q1603 = Q180 * 100 + Q181 * 10 + Q182
; on the lower limit
QL1 = 60.05
QL2 = 60.02
CALL LBL 1
Q1606 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um below
QL2 = 60.0201
CALL LBL 1
Q1604 = Q180 * 100 + Q181 * 10 + Q182
; centre out of tolerance
QL2 = 59.95
QL3 = 0.0099
CALL LBL 1
Q1605 = Q180 * 100 + Q181 * 10 + Q182
; stops: too large
QL1 = 60
QL3 = 0.05
QL5 = 1
CALL LBL 1
END PGM BOLTS MM

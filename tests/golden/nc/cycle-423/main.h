BEGIN PGM POCKET MM
; Two lengths and a centre: good, on each limit and beyond it.
TOOL CALL 30 Z
QL1 = 0 ; Q301
QL2 = 60.03 ; Q284
QL3 = 59.97 ; Q285
QL4 = 40.03 ; Q286
QL5 = 39.97 ; Q287
QL6 = 0.05 ; Q279
QL7 = 1 ; Q281
QL8 = 0 ; Q309
LBL 1
TCH PROBE 423 MEAS. RECTAN. INSIDE ~
    Q273=+100 ~
    Q274=+80 ~
    Q282=+60 ~
    Q283=+40 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+20 ~
    Q301=+QL1 ~
    Q284=+QL2 ~
    Q285=+QL3 ~
    Q286=+QL4 ~
    Q287=+QL5 ~
    Q279=+QL6 ~
    Q280=+0.05 ~
    Q281=+QL7 ~
    Q309=+QL8 ~
    Q330=+0
LBL 0
Q1601 = Q180 * 100 + Q181 * 10 + Q182
; main axis on its upper limit
QL2 = 60.02
QL7 = 0
CALL LBL 1
Q1602 = Q180 * 100 + Q181 * 10 + Q182
; main axis 0.1 um above
QL2 = 60.0199
CALL LBL 1
Q1603 = Q180 * 100 + Q181 * 10 + Q182
; main axis 0.1 um below
QL2 = 60.03
QL3 = 60.0201
CALL LBL 1
Q1604 = Q180 * 100 + Q181 * 10 + Q182
; secondary axis on its lower limit
QL3 = 59.97
QL5 = 40.01
CALL LBL 1
Q1605 = Q180 * 100 + Q181 * 10 + Q182
; secondary axis 0.1 um above
QL4 = 40.0099
QL5 = 39.97
CALL LBL 1
Q1606 = Q180 * 100 + Q181 * 10 + Q182
; secondary axis 0.1 um below
QL4 = 40.03
QL5 = 40.0101
CALL LBL 1
Q1607 = Q180 * 100 + Q181 * 10 + Q182
; centre out of tolerance, over the clearance height
QL1 = 1
QL5 = 39.97
QL6 = 0.0199
CALL LBL 1
Q1608 = Q180 * 100 + Q181 * 10 + Q182
; stops: secondary axis
QL1 = 0
QL4 = 40
QL6 = 0.05
QL8 = 1
CALL LBL 1
END PGM POCKET MM

BEGIN PGM SLOT MM
; The width of a slot: good, on each limit and beyond it.
TOOL CALL 30 Z
QL1 = 30.03 ; Q288
QL2 = 29.97 ; Q289
QL3 = 1 ; Q281
QL4 = 0 ; Q309
LBL 1
TCH PROBE 425 MEASURE INSIDE WIDTH ~
    Q328=+100 ~
    Q329=+80 ~
    Q310=+0 ~
    Q272=+2 ~
    Q261=-5 ~
    Q260=+20 ~
    Q311=+30 ~
    Q288=+QL1 ~
    Q289=+QL2 ~
    Q281=+QL3 ~
    Q309=+QL4 ~
    Q330=+0
LBL 0
Q1601 = Q180 * 100 + Q181 * 10 + Q182
; on the upper limit
QL1 = 30.01
QL3 = 0
CALL LBL 1
Q1602 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um above
QL1 = 30.0099
CALL LBL 1
Q1603 = Q180 * 100 + Q181 * 10 + Q182
; on the lower limit
QL1 = 30.03
QL2 = 30.01
CALL LBL 1
Q1604 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um below
QL2 = 30.0101
CALL LBL 1
Q1605 = Q180 * 100 + Q181 * 10 + Q182
; two places, over the clearance height
TCH PROBE 425 MEASURE INSIDE WIDTH ~
    Q328=+100 ~
    Q329=+80 ~
    Q310=-15 ~
    Q272=+2 ~
    Q261=-5 ~
    Q260=+20 ~
    Q311=+30 ~
    Q288=+30.03 ~
    Q289=+29.97 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0 ~
    Q301=+1 ~
    Q320=+1
Q1606 = Q180 * 100 + Q181 * 10 + Q182
; stops: too wide
QL1 = 30
QL2 = 29.97
QL4 = 1
CALL LBL 1
END PGM SLOT MM

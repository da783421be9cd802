%BOLTS G71 *
; Three holes of a bolt circle: good, on the limit, beyond it, off their centre.
N10 T30 G17 *
N20 QL1 = 60.05 * ; Q288
N30 QL2 = 59.95 * ; Q289
N40 QL3 = 0.05 * ; Q279
N50 QL4 = 1 * ; Q281
N60 QL5 = 0 * ; Q309
N70 G98 L1 *
N80 G430 MEAS. BOLT HOLE CIRC ~
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
    Q330=+0 *
N90 G98 L0 *
N100 Q1601 = Q180 * 100 + Q181 * 10 + Q182 *
; on the upper limit
N110 QL1 = 60.02 *
N120 QL4 = 0 *
N130 L1,0 *
N140 Q1602 = Q180 * 100 + Q181 * 10 + Q182 *
; 0.1 um above
N150 QL1 = 60.0199 *
N160 L1,0 *
N170 Q1603 = Q180 * 100 + Q181 * 10 + Q182 *
; on the lower limit
N180 QL1 = 60.05 *
N190 QL2 = 60.02 *
N200 L1,0 *
N210 Q1606 = Q180 * 100 + Q181 * 10 + Q182 *
; 0.1 um below
N220 QL2 = 60.0201 *
N230 L1,0 *
N240 Q1604 = Q180 * 100 + Q181 * 10 + Q182 *
; centre out of tolerance
N250 QL2 = 59.95 *
N260 QL3 = 0.0099 *
N270 L1,0 *
N280 Q1605 = Q180 * 100 + Q181 * 10 + Q182 *
; stops: too large
N290 QL1 = 60 *
N300 QL3 = 0.05 *
N310 QL5 = 1 *
N320 L1,0 *
N99999999 %BOLTS G71 *

%HOLE G71 *
; The hole of the control's own log: good, on each limit, beyond it, off its centre.
N10 T30 G17 *
N20 QL1 = 0 * ; Q301
N30 QL2 = 12.045 * ; Q275
N40 QL3 = 12 * ; Q276
N50 QL4 = 0.1 * ; Q279
N60 QL5 = 1 * ; Q281
N70 QL6 = 0 * ; Q309
N80 G98 L1 *
N90 G421 MEASURE HOLE ~
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
    Q330=+0 *
N100 G98 L0 *
N110 Q1601 = Q180 * 100 + Q181 * 10 + Q182 *
; on the upper limit
N120 QL2 = 12.0259 *
N130 QL5 = 0 *
N140 L1,0 *
N150 Q1602 = Q180 * 100 + Q181 * 10 + Q182 *
; 0.1 um above the upper limit
N160 QL2 = 12.0258 *
N170 L1,0 *
N180 Q1603 = Q180 * 100 + Q181 * 10 + Q182 *
; on the lower limit
N190 QL2 = 12.045 *
N200 QL3 = 12.0259 *
N210 L1,0 *
N220 Q1604 = Q180 * 100 + Q181 * 10 + Q182 *
; 0.1 um below the lower limit
N230 QL3 = 12.026 *
N240 L1,0 *
N250 Q1605 = Q180 * 100 + Q181 * 10 + Q182 *
; centre out of tolerance
N260 QL3 = 12 *
N270 QL4 = 0.0809 *
N280 L1,0 *
N290 Q1606 = Q180 * 100 + Q181 * 10 + Q182 *
; no limits, three touches
N300 G421 MEASURE HOLE ~
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
    Q423=+3 *
N310 Q1607 = Q180 * 100 + Q181 * 10 + Q182 *
; over the clearance height
N320 QL1 = 1 *
N330 QL4 = 0.1 *
N340 L1,0 *
N350 Q1608 = Q180 * 100 + Q181 * 10 + Q182 *
; stops: too large
N360 QL1 = 0 *
N370 QL2 = 12.02 *
N380 QL6 = 1 *
N390 L1,0 *
N99999999 %HOLE G71 *

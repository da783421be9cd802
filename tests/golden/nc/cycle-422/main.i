%STUD G71 *
; A stud: good with a corrected tool, on each limit, beyond it, off its centre.
N10 T30 G17 *
N20 QL1 = 25 * ; Q277
N30 QL2 = 24.979 * ; Q278
N40 QL3 = 0.05 * ; Q280
N50 QL4 = 1 * ; Q281
N60 QL5 = 0 * ; Q309
N70 QL6 = 7 * ; Q330
N80 G98 L1 *
N90 G422 MEAS. CIRCLE OUTSIDE ~
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
    Q330=+QL6 *
N100 G98 L0 *
N110 Q1601 = Q180 * 100 + Q181 * 10 + Q182 *
N120 D18: SYSREAD Q1600 = ID50 NR5 IDX7 *
; on the upper limit
N130 QL1 = 24.99 *
N140 QL4 = 0 *
N150 QL6 = 0 *
N160 L1,0 *
N170 Q1602 = Q180 * 100 + Q181 * 10 + Q182 *
; 0.1 um above the upper limit
N180 QL1 = 24.9899 *
N190 L1,0 *
N200 Q1603 = Q180 * 100 + Q181 * 10 + Q182 *
; on the lower limit
N210 QL1 = 25 *
N220 QL2 = 24.99 *
N230 L1,0 *
N240 Q1604 = Q180 * 100 + Q181 * 10 + Q182 *
; 0.1 um below the lower limit
N250 QL2 = 24.9901 *
N260 L1,0 *
N270 Q1605 = Q180 * 100 + Q181 * 10 + Q182 *
; centre out of tolerance
N280 QL2 = 24.979 *
N290 QL3 = 0.0299 *
N300 L1,0 *
N310 Q1606 = Q180 * 100 + Q181 * 10 + Q182 *
; three touches over the clearance height
N320 G422 MEAS. CIRCLE OUTSIDE ~
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
    Q423=+3 *
N330 Q1607 = Q180 * 100 + Q181 * 10 + Q182 *
; stops: too small
N340 QL2 = 24.995 *
N350 QL3 = 0.05 *
N360 QL5 = 1 *
N370 L1,0 *
N99999999 %STUD G71 *

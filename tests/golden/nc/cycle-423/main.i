%POCKET G71 *
; Two lengths and a centre: good, on each limit and beyond it.
N10 T30 G17 *
N20 QL1 = 0 * ; Q301
N30 QL2 = 60.03 * ; Q284
N40 QL3 = 59.97 * ; Q285
N50 QL4 = 40.03 * ; Q286
N60 QL5 = 39.97 * ; Q287
N70 QL6 = 0.05 * ; Q279
N80 QL7 = 1 * ; Q281
N90 QL8 = 0 * ; Q309
N100 G98 L1 *
N110 G423 MEAS. RECTAN. INSIDE ~
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
    Q330=+0 *
N120 G98 L0 *
N130 Q1601 = Q180 * 100 + Q181 * 10 + Q182 *
; main axis on its upper limit
N140 QL2 = 60.02 *
N150 QL7 = 0 *
N160 L1,0 *
N170 Q1602 = Q180 * 100 + Q181 * 10 + Q182 *
; main axis 0.1 um above
N180 QL2 = 60.0199 *
N190 L1,0 *
N200 Q1603 = Q180 * 100 + Q181 * 10 + Q182 *
; main axis 0.1 um below
N210 QL2 = 60.03 *
N220 QL3 = 60.0201 *
N230 L1,0 *
N240 Q1604 = Q180 * 100 + Q181 * 10 + Q182 *
; secondary axis on its lower limit
N250 QL3 = 59.97 *
N260 QL5 = 40.01 *
N270 L1,0 *
N280 Q1605 = Q180 * 100 + Q181 * 10 + Q182 *
; secondary axis 0.1 um above
N290 QL4 = 40.0099 *
N300 QL5 = 39.97 *
N310 L1,0 *
N320 Q1606 = Q180 * 100 + Q181 * 10 + Q182 *
; secondary axis 0.1 um below
N330 QL4 = 40.03 *
N340 QL5 = 40.0101 *
N350 L1,0 *
N360 Q1607 = Q180 * 100 + Q181 * 10 + Q182 *
; centre out of tolerance, over the clearance height
N370 QL1 = 1 *
N380 QL5 = 39.97 *
N390 QL6 = 0.0199 *
N400 L1,0 *
N410 Q1608 = Q180 * 100 + Q181 * 10 + Q182 *
; stops: secondary axis
N420 QL1 = 0 *
N430 QL4 = 40 *
N440 QL6 = 0.05 *
N450 QL8 = 1 *
N460 L1,0 *
N99999999 %POCKET G71 *

%FACE G71 *
; The coordinate of a face: good with a corrected tool, on each limit and beyond it.
N10 T30 G17 *
N20 QL1 = 50 * ; Q263
N30 QL2 = 0 * ; Q261
N40 QL3 = 3 * ; Q272
N50 QL4 = 1 * ; Q281
N60 QL5 = 0.02 * ; Q288
N70 QL6 = -0.02 * ; Q289
N80 QL7 = 0 * ; Q309
N90 QL8 = 7 * ; Q330
N100 G98 L1 *
N110 G427 MEASURE COORDINATE ~
    Q263=+QL1 ~
    Q264=+40 ~
    Q261=+QL2 ~
    Q320=+0 ~
    Q272=+QL3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+QL4 ~
    Q288=+QL5 ~
    Q289=+QL6 ~
    Q309=+QL7 ~
    Q330=+QL8 *
N120 G98 L0 *
N130 Q1601 = Q180 * 100 + Q181 * 10 + Q182 *
N140 D18: SYSREAD Q1600 = ID50 NR4 IDX7 *
; on the upper limit
N150 QL4 = 0 *
N160 QL5 = 0.013 *
N170 QL8 = 0 *
N180 L1,0 *
N190 Q1602 = Q180 * 100 + Q181 * 10 + Q182 *
; 0.1 um above
N200 QL5 = 0.0129 *
N210 L1,0 *
N220 Q1603 = Q180 * 100 + Q181 * 10 + Q182 *
; on the lower limit
N230 QL5 = 0.02 *
N240 QL6 = 0.013 *
N250 L1,0 *
N260 Q1604 = Q180 * 100 + Q181 * 10 + Q182 *
; 0.1 um below
N270 QL6 = 0.0131 *
N280 L1,0 *
N290 Q1605 = Q180 * 100 + Q181 * 10 + Q182 *
; a face in the main axis
N300 QL1 = 200 *
N310 QL2 = -5 *
N320 QL3 = 1 *
N330 QL5 = 200.01 *
N340 QL6 = 199.99 *
N350 L1,0 *
N360 Q1606 = Q180 * 100 + Q181 * 10 + Q182 *
; stops: too high
N370 QL1 = 50 *
N380 QL2 = 0 *
N390 QL3 = 3 *
N400 QL5 = 0.01 *
N410 QL6 = -0.02 *
N420 QL7 = 1 *
N430 L1,0 *
N99999999 %FACE G71 *

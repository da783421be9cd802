%RIDGE G71 *
; The width of a ridge: good, on each limit and beyond it.
N10 T30 G17 *
N20 QL1 = 30.03 * ; Q288
N30 QL2 = 29.97 * ; Q289
N40 QL3 = 1 * ; Q281
N50 QL4 = 0 * ; Q309
N60 G98 L1 *
N70 G426 MEASURE RIDGE WIDTH ~
    Q263=+100 ~
    Q264=+95 ~
    Q265=+100 ~
    Q266=+65 ~
    Q272=+2 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+20 ~
    Q311=+30 ~
    Q288=+QL1 ~
    Q289=+QL2 ~
    Q281=+QL3 ~
    Q309=+QL4 ~
    Q330=+0 *
N80 G98 L0 *
N90 Q1601 = Q180 * 100 + Q181 * 10 + Q182 *
; on the upper limit
N100 QL1 = 30.01 *
N110 QL3 = 0 *
N120 L1,0 *
N130 Q1602 = Q180 * 100 + Q181 * 10 + Q182 *
; 0.1 um above
N140 QL1 = 30.0099 *
N150 L1,0 *
N160 Q1603 = Q180 * 100 + Q181 * 10 + Q182 *
; on the lower limit
N170 QL1 = 30.03 *
N180 QL2 = 30.01 *
N190 L1,0 *
N200 Q1604 = Q180 * 100 + Q181 * 10 + Q182 *
; 0.1 um below
N210 QL2 = 30.0101 *
N220 L1,0 *
N230 Q1605 = Q180 * 100 + Q181 * 10 + Q182 *
; stops: too wide
N240 QL1 = 30 *
N250 QL2 = 29.97 *
N260 QL4 = 1 *
N270 L1,0 *
N99999999 %RIDGE G71 *

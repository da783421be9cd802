BEGIN PGM RIDGE MM
; The width of a ridge: good, on each limit and beyond it.
TOOL CALL 30 Z
TCH PROBE 426 MEASURE RIDGE WIDTH ~
    Q263=+100 ~
    Q264=+95 ~
    Q265=+100 ~
    Q266=+65 ~
    Q272=+2 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+20 ~
    Q311=+30 ~
    Q288=+30.03 ~
    Q289=+29.97 ~
    Q281=+1 ~
    Q309=+0 ~
    Q330=+0
Q1601 = Q180 * 100 + Q181 * 10 + Q182
; on the upper limit
TCH PROBE 426 MEASURE RIDGE WIDTH ~
    Q263=+100 ~
    Q264=+95 ~
    Q265=+100 ~
    Q266=+65 ~
    Q272=+2 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+20 ~
    Q311=+30 ~
    Q288=+30.01 ~
    Q289=+29.97 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1602 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um above
TCH PROBE 426 MEASURE RIDGE WIDTH ~
    Q263=+100 ~
    Q264=+95 ~
    Q265=+100 ~
    Q266=+65 ~
    Q272=+2 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+20 ~
    Q311=+30 ~
    Q288=+30.0099 ~
    Q289=+29.97 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1603 = Q180 * 100 + Q181 * 10 + Q182
; on the lower limit
TCH PROBE 426 MEASURE RIDGE WIDTH ~
    Q263=+100 ~
    Q264=+95 ~
    Q265=+100 ~
    Q266=+65 ~
    Q272=+2 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+20 ~
    Q311=+30 ~
    Q288=+30.03 ~
    Q289=+30.01 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1604 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um below
TCH PROBE 426 MEASURE RIDGE WIDTH ~
    Q263=+100 ~
    Q264=+95 ~
    Q265=+100 ~
    Q266=+65 ~
    Q272=+2 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+20 ~
    Q311=+30 ~
    Q288=+30.03 ~
    Q289=+30.0101 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1605 = Q180 * 100 + Q181 * 10 + Q182
; stops: too wide
TCH PROBE 426 MEASURE RIDGE WIDTH ~
    Q263=+100 ~
    Q264=+95 ~
    Q265=+100 ~
    Q266=+65 ~
    Q272=+2 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+20 ~
    Q311=+30 ~
    Q288=+30 ~
    Q289=+29.97 ~
    Q281=+0 ~
    Q309=+1 ~
    Q330=+0
END PGM RIDGE MM

BEGIN PGM FACE MM
; The coordinate of a face: good with a corrected tool, on each limit and beyond it.
TOOL CALL 30 Z
TCH PROBE 427 MEASURE COORDINATE ~
    Q263=+50 ~
    Q264=+40 ~
    Q261=+0 ~
    Q320=+0 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+1 ~
    Q288=+0.02 ~
    Q289=-0.02 ~
    Q309=+0 ~
    Q330=+7
Q1601 = Q180 * 100 + Q181 * 10 + Q182
FN 18: SYSREAD Q1600 = ID50 NR4 IDX7
; on the upper limit
TCH PROBE 427 MEASURE COORDINATE ~
    Q263=+50 ~
    Q264=+40 ~
    Q261=+0 ~
    Q320=+0 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+0 ~
    Q288=+0.013 ~
    Q289=-0.02 ~
    Q309=+0 ~
    Q330=+0
Q1602 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um above
TCH PROBE 427 MEASURE COORDINATE ~
    Q263=+50 ~
    Q264=+40 ~
    Q261=+0 ~
    Q320=+0 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+0 ~
    Q288=+0.0129 ~
    Q289=-0.02 ~
    Q309=+0 ~
    Q330=+0
Q1603 = Q180 * 100 + Q181 * 10 + Q182
; on the lower limit
TCH PROBE 427 MEASURE COORDINATE ~
    Q263=+50 ~
    Q264=+40 ~
    Q261=+0 ~
    Q320=+0 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+0 ~
    Q288=+0.02 ~
    Q289=+0.013 ~
    Q309=+0 ~
    Q330=+0
Q1604 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um below
TCH PROBE 427 MEASURE COORDINATE ~
    Q263=+50 ~
    Q264=+40 ~
    Q261=+0 ~
    Q320=+0 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+0 ~
    Q288=+0.02 ~
    Q289=+0.0131 ~
    Q309=+0 ~
    Q330=+0
Q1605 = Q180 * 100 + Q181 * 10 + Q182
; a face in the main axis
TCH PROBE 427 MEASURE COORDINATE ~
    Q263=+200 ~
    Q264=+40 ~
    Q261=-5 ~
    Q320=+0 ~
    Q272=+1 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+0 ~
    Q288=+200.01 ~
    Q289=+199.99 ~
    Q309=+0 ~
    Q330=+0
Q1606 = Q180 * 100 + Q181 * 10 + Q182
; stops: too high
TCH PROBE 427 MEASURE COORDINATE ~
    Q263=+50 ~
    Q264=+40 ~
    Q261=+0 ~
    Q320=+0 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+0 ~
    Q288=+0.01 ~
    Q289=-0.02 ~
    Q309=+1 ~
    Q330=+0
END PGM FACE MM
